"""How a check of the sources tells what it found."""
import pathlib
import sys


def tell(of, faults):
    """Prints the faults that `faults` finds under the folder that the command line names; the exit status says whether there are any."""
    found = list(faults(pathlib.Path(sys.argv[1])))
    for fault in found:
        print(fault)
    print(f"{of}: {len(found)} fault(s)")
    return 1 if found else 0
