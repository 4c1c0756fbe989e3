"""Ends a Blender that hangs, and says where it hangs."""
import faulthandler
import os
import time

START = time.monotonic()


def begin():
    """After NOOK_WINDOW_SECONDS, Blender ends with the Python stack of each thread on stderr. A thread of its own does this, so that
    it happens even if Blender waits for itself."""
    faulthandler.dump_traceback_later(float(os.environ.get("NOOK_WINDOW_SECONDS", 600)), exit=True)


def say(text):
    """A line with the seconds since the start, which tells a slow run from one that hangs."""
    print(f"{time.monotonic() - START:6.1f} s  {text}", flush=True)
