"""The type stubs and the documentation name what the module has, and nothing else."""

import ast
import inspect
import pathlib
import re

import pytest

import sigmascape

STUB = ast.parse(pathlib.Path(sigmascape.__file__).with_suffix(".pyi").read_text())
INHERITED = set(dir(ValueError)) | {"__init__", "__module__", "__weakref__"}


def names_in(body):
    names = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
    return {name for name in names if not name.startswith("_")}


def test_stubs_name_what_the_module_has():
    assert names_in(STUB.body) == set(sigmascape.__all__)


@pytest.mark.parametrize("name", [name for name in sigmascape.__all__ if inspect.isclass(getattr(sigmascape, name)) and name != "Error"])
def test_stubs_name_what_a_class_has(name):
    stub = next(node for node in STUB.body if isinstance(node, ast.ClassDef) and node.name == name)
    assert names_in(stub.body) == {member for member in dir(getattr(sigmascape, name)) if not member.startswith("_")}


FUNCTIONS = [name for name in sigmascape.__all__ if not inspect.isclass(getattr(sigmascape, name))]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_stubs_name_the_arguments_of_functions(name):
    arguments = next(node for node in STUB.body if isinstance(node, ast.FunctionDef) and node.name == name).args
    signature = getattr(sigmascape, name).__doc__.splitlines()[0]
    for argument in arguments.args + arguments.kwonlyargs:
        assert f"{argument.arg}:" in signature
    assert signature.count(": ") == len(arguments.args + arguments.kwonlyargs)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_take_what_is_optional_by_keyword(name):
    """Defaults of the stub are those of the module, where both say them plainly."""
    arguments = next(node for node in STUB.body if isinstance(node, ast.FunctionDef) and node.name == name).args
    signature = getattr(sigmascape, name).__doc__.splitlines()[0]
    for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults):
        value = ast.literal_eval(default) if default is not None and not ast.unparse(default) == "..." else None
        if isinstance(value, (int, float, str)):
            found = re.search(rf"\b{argument.arg}: [^=]*? = ('[^']*'|[^,)]+)", signature)
            assert found and ast.literal_eval(found.group(1)) == pytest.approx(value), argument.arg


def test_everything_is_documented():
    for name in sigmascape.__all__:
        entry = getattr(sigmascape, name)
        assert entry.__doc__, name
        if inspect.isclass(entry) and name != "Error":
            continue
        # Below the signature stand words.
        assert len(entry.__doc__.strip().splitlines()) > 1 or name == "Error", name
    assert "Scene.read" in sigmascape.__doc__
    for name in ["render", "bake", "layers", "make_dataset", "phase_history", "compare", "Target"]:
        assert f"sigmascape.{name}(" in sigmascape.__doc__, name
