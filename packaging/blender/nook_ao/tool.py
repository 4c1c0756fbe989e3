"""Runs the command `nook` as a process that reports its progress line by line."""
import os
import queue
import shutil
import subprocess
import threading

from .faults import Fault


def find(path):
    """Returns the command at the path from the preferences, or on the search path of the system."""
    found = shutil.which(path or "nook")
    if found is None:
        raise Fault(f"the command {path or 'nook'} was not found; install Nook, or set its path in the preferences of the add-on")
    return found


# The value that work yields between slices while a command runs.
WAITING = object()


class Run:
    """A running command. A thread reads its output, so that Blender does not wait for the command."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.last_line = ""
        self.errors = ""
        self._lines = queue.Queue()
        try:
            self._process = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                             errors="replace", env={**os.environ, "LC_ALL": "C.UTF-8"})
        except OSError as error:
            raise Fault(f"the command {arguments[0]} does not start ({error.strerror}); check its path in the preferences of the add-on") from error
        self._readers = [threading.Thread(target=self._read, args=(stream, kind), daemon=True)
                         for stream, kind in ((self._process.stdout, "line"), (self._process.stderr, "error"))]
        for reader in self._readers:
            reader.start()

    def _read(self, stream, kind):
        for line in stream:
            self._lines.put((kind, line.rstrip()))
        stream.close()

    def _take(self):
        while True:
            try:
                kind, line = self._lines.get_nowait()
            except queue.Empty:
                return
            if line.startswith("nook: "):
                self.errors = line[6:]
            elif line:
                self.last_line = line

    def is_done(self):
        """Returns whether the command has ended. `last_line` has the last line of its output."""
        done = self._process.poll() is not None
        if done:
            for reader in self._readers:
                reader.join()
        self._take()
        return done

    def wait(self):
        self._process.wait()
        self.is_done()

    def cancel(self):
        """Ends the command if it still runs. The command does not leave incomplete files."""
        if self._process.poll() is None:
            self._process.terminate()
        self.wait()

    def check(self):
        """Raises an error with the command's message if the command failed."""
        code = self._process.returncode
        if code != 0:
            raise Fault(f"nook failed with exit code {code}: {self.errors or self.last_line or 'it printed no message'}")
