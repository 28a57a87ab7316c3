# SPDX-License-Identifier: BSD-3-Clause
"""Finds known objects and their 6-D poses in point clouds. See docs/python.md.

In a catkin workspace this is also the package of the messages: sks_detector.msg and sks_detector.srv. The compiled part
is loaded when one of its names is first used, so that who only wants messages does not pay for it."""
import importlib as _importlib
import pkgutil as _pkgutil

# Messages and compiled part may be in different folders of sys.path.
__path__ = _pkgutil.extend_path(__path__, __name__)

__all__ = ["Cloud", "Codebook", "Detection", "Detector", "Error", "Sample", "evaluate", "read_cloud", "train"]


def __getattr__(name):
    if name not in __all__:
        raise AttributeError("module %r has no attribute %r" % (__name__, name))
    value = getattr(_importlib.import_module(__name__ + "._core"), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted(set(globals()) | set(__all__))
