"""Loads the Python module of Nook: the copy inside the add-on, or the installed module."""
import os

from .faults import Fault

try:
    from . import nook
except ImportError:
    try:
        import nook
    except ImportError:
        nook = None


def load(paths):
    """Returns the module. Its shared libraries are loaded from `paths`, or from the system's places if
    `paths` is empty."""
    if nook is None:
        raise Fault("the Python module nook is missing; install the add-on from the .zip file of a release, which contains the module")
    if paths:
        for path in paths.split(os.pathsep):
            if not os.path.isfile(path):
                raise Fault(f"the shared library {path} does not exist; set its path in the preferences of the add-on")
        os.environ["NOOK_LIBRARY"] = paths
    try:
        nook.Context()
    except nook.MissingLibrary as error:
        raise Fault(f"{error}; or set the path in the preferences of the add-on") from error
    return nook
