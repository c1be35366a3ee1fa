#!/usr/bin/python3
"""Runs the pods of examples/clusters/kubernetes.yaml without Kubernetes: their own command, once for each index, in a folder in place of the
volume. One is killed at work, one evicted, and both started again, as the job would do it. The atlas must be that of a local bake, byte for byte.

Usage: kubernetes_test.py SIGMASCAPE SOURCE_FOLDER. Ends with 77 where PyYAML is not installed.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

try:
    import yaml
except ImportError:
    print("SKIPPED: PyYAML is not installed (package python3-yaml); the job file of Kubernetes was NOT tried.", file=sys.stderr)
    sys.exit(77)

FRAME = "+proj=tmerc +lat_0=43 +lon_0=-3 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m"
SCENE = f"""[scene]
origin_lat_deg = 43
origin_lon_deg = -3
extent = {{west_m = 10, south_m = 10, east_m = 90, north_m = 90}}
[terrain]
file = "heights.asc"
crs = "{FRAME}"
[[buildings]]
file = "houses.csv"
crs = "{FRAME}"
height_attribute = "height"
"""


def write_town(folder):
    """A dozen houses in one patch, so that a look is baked in a tenth of a second."""
    folder.mkdir()
    (folder / "town.toml").write_text(SCENE)
    (folder / "heights.asc").write_text("ncols 4\nnrows 4\nxllcorner -50\nyllcorner -50\ncellsize 50\n" + "10 " * 16)
    houses = [f'"POLYGON (({x} {y}, {x + 12} {y}, {x + 12} {y + 9}, {x} {y + 9}, {x} {y}))",{5 + x % 4}\n'
              for x in range(15, 100, 30) for y in range(15, 100, 25)]
    (folder / "houses.csv").write_text("WKT,height\n" + "".join(houses))


def check(holds, what):
    if not holds:
        sys.exit(f"FAILED: {what}")


class IndexedJob:
    """What Kubernetes would make of the file."""

    def __init__(self, file):
        job = yaml.safe_load(file.read_text())
        check((job["apiVersion"], job["kind"]) == ("batch/v1", "Job"), "the file is a Job of batch/v1")
        spec = job["spec"]
        check(spec["completionMode"] == "Indexed", "each pod has an index")
        self.completions, self.parallelism = spec["completions"], spec["parallelism"]
        check(0 < self.parallelism <= self.completions, "some pods run at a time, no more than there are")
        check(spec["backoffLimitPerIndex"] > 0, "a pod that failed is started again, whatever became of others")
        pod = spec["template"]["spec"]
        check(pod["restartPolicy"] == "Never", "the limit of an index and the policy of failures want pods that do not restart")
        check(len(pod["containers"]) == 1, "a pod is one container")
        self.check_failures(spec["podFailurePolicy"]["rules"], pod["containers"][0]["name"])
        self.check_container(pod["containers"][0], pod["volumes"])

    def check_failures(self, rules, container):
        """The first rule that fits decides."""
        taken_away = {"action": "Ignore", "onPodConditions": [{"type": "DisruptionTarget", "status": "True"}]}
        check(rules[0] == taken_away, "pods that the cluster takes away do not count as failed")
        not_understood = {"containerName": container, "operator": "In", "values": [2]}
        check(rules[1:] == [{"action": "FailJob", "onExitCodes": not_understood}], "a line that is not understood is not tried again")

    def check_container(self, container, volumes):
        check(re.fullmatch(r"[\w./-]+:[\w.-]+", container["image"]), "the image has a name and a tag")
        self.command, self.arguments = container["command"], container["args"]
        for words in (self.command, self.arguments):
            check(isinstance(words, list) and all(isinstance(word, str) for word in words), "command and args are lists of words")
        check(len(self.arguments) == 1, "the shell gets one script")
        self.variables = {variable["name"]: variable["value"] for variable in container["env"]}
        check(all(isinstance(value, str) for value in self.variables.values()), "values of variables are in quotes")
        check(self.variables["SHARES"] == str(self.completions), "there are as many completions as shares")
        check('--shard "$JOB_COMPLETION_INDEX/$SHARES"' in self.arguments[0], "the share is the pod's index")
        processors = {resources["cpu"] for resources in container["resources"].values()}
        check(processors == set(re.findall(r"--threads (\d+)", self.arguments[0])), "a pod has as many processors as threads")
        mounted = {mount["name"]: mount["mountPath"] for mount in container["volumeMounts"]}
        check(mounted == {"data": "/data"}, "the volume is /data")
        check([volume["name"] for volume in volumes if "persistentVolumeClaim" in volume] == ["data"], "the volume is one that pods share")

    def pod(self, index, volume, sigmascape, within=()):
        """Starts the command of one pod with a folder for its volume, by the command `within`."""
        environment = os.environ | self.variables | {"JOB_COMPLETION_INDEX": str(index), "PATH": f"{sigmascape.parent}:{os.environ['PATH']}"}
        script = self.arguments[0].replace("/data", str(volume))
        return subprocess.Popen([*within, *self.command, script], cwd="/", env=environment, stdout=subprocess.DEVNULL)


def looks_done(log):
    """Of a share so far, by the last whole line of its log."""
    lines = log.read_text().split("\n")[:-1] if log.exists() else []
    return json.loads(lines[-1])["looks_done"] if lines else 0


def kill_at_work(pod, log):
    """Kills a pod when it has baked a look, and sees that it was not done."""
    while looks_done(log) < 1 and pod.poll() is None:
        time.sleep(0.005)
    pod.kill()
    check(pod.wait() == -signal.SIGKILL, "a pod is killed before it is done")
    check(1 <= looks_done(log) < json.loads(log.read_text().split("\n")[0])["looks_total"], "the killed pod left looks to bake")


# As a container runtime starts it: a command is the first process of its own, which signals that it does not handle do not end.
CONTAINER = ("unshare", "--user", "--map-root-user", "--pid", "--fork")


def containers_are_allowed():
    allowed = shutil.which(CONTAINER[0]) and subprocess.run([*CONTAINER, "true"], capture_output=True).returncode == 0
    if not allowed:
        print("SKIPPED: process namespaces are not allowed here; eviction was NOT tried.", file=sys.stderr)
    return allowed


def evict_at_work(container, log):
    """Asks a pod to end when it has baked a look, as a cluster does half a minute before it kills it."""
    while looks_done(log) < 1 and container.poll() is None:
        time.sleep(0.005)
    first = pathlib.Path(f"/proc/{container.pid}/task/{container.pid}/children").read_text().split()
    check(len(first) == 1, "the pod is at work")
    os.kill(int(first[0]), signal.SIGTERM)
    try:
        code = container.wait(timeout=10)
    except subprocess.TimeoutExpired:
        os.kill(int(first[0]), signal.SIGKILL)
        code = container.wait()
    check(code == 128 + signal.SIGTERM, f"an evicted pod ends by the signal, not with {code}")


def files_of(atlas):
    """By name. What a killed process was writing may stay where another might be writing it: the collection, catalogs, the pyramid."""
    def may_stay(name):
        return name.endswith(".tmp") and (not name.startswith("patch") or "/.catalog.json" in name)

    names = (str(path.relative_to(atlas)) for path in atlas.rglob("*") if path.is_file())
    return {name: (atlas / name).read_bytes() for name in names if not may_stay(name)}


def bake_by_pods(job, volume, sigmascape):
    killed = 3
    kill_at_work(job.pod(killed, volume, sigmascape), volume / "logs" / f"bake-{killed}.jsonl")
    evicted = 5
    if containers_are_allowed():
        evict_at_work(job.pod(evicted, volume, sigmascape, CONTAINER), volume / "logs" / f"bake-{evicted}.jsonl")
    for first in range(0, job.completions, job.parallelism):
        pods = [job.pod(index, volume, sigmascape) for index in range(first, min(first + job.parallelism, job.completions))]
        check([pod.wait() for pod in pods] == [0] * len(pods), "every pod ends well")
    for index in range(job.completions):
        lines = (volume / "logs" / f"bake-{index}.jsonl").read_text().splitlines()
        check(json.loads(lines[-1])["seconds_left"] == 0, f"the log of pod {index} tells its end")


def main():
    sigmascape, source_folder = (pathlib.Path(word).absolute() for word in sys.argv[1:])
    job = IndexedJob(source_folder / "examples" / "clusters" / "kubernetes.yaml")
    with tempfile.TemporaryDirectory(prefix="sigmascape_kubernetes.") as folder:
        volume, local = pathlib.Path(folder) / "volume", pathlib.Path(folder) / "local"
        write_town(volume)
        bake_by_pods(job, volume, sigmascape)
        subprocess.run([sigmascape, "bake", volume / "town.toml", "--out", local, "--samples", "64"], check=True)
        by_pods, by_one = files_of(volume / "atlas"), files_of(local)
        check(by_pods.keys() == by_one.keys(), f"the same files, but {sorted(by_pods.keys() ^ by_one.keys())[:5]}")
        check(by_pods == by_one, f"the same bytes, but of {[name for name in sorted(by_one) if by_pods[name] != by_one[name]][:5]}")
        subprocess.run([sigmascape, "atlas", "verify", volume / "atlas"], check=True)


if __name__ == "__main__":
    main()
