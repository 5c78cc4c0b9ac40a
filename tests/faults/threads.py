"""Stops one thread of a process and lets the others run, as a thread does that hangs: ptrace, without a debugger."""

import ctypes
import os
from pathlib import Path

SEIZE, INTERRUPT, DETACH = 0x4206, 0x4207, 17
# Waits for threads as well as for processes.
WALL = 0x40000000

libc = ctypes.CDLL(None, use_errno=True)
libc.ptrace.argtypes = [ctypes.c_long, ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p]
libc.ptrace.restype = ctypes.c_long


def ptrace(request, thread):
    if libc.ptrace(request, thread, None, None) != 0:
        number = ctypes.get_errno()
        raise OSError(number, f"ptrace {request:#x} of thread {thread}: {os.strerror(number)}")


def thread_of(process, name=None):
    """The number of a process's thread: by its name, or the first one, which is the node's."""
    if name is None:
        return process
    for task in Path(f"/proc/{process}/task").iterdir():
        if (task / "comm").read_text().strip() == name:
            return int(task.name)
    raise LookupError(f"process {process} has no thread {name}")


class Hang:
    """A thread that hangs from `begin` to `end`. Both must be called by the same thread."""

    def __init__(self, process, name=None):
        self.thread = thread_of(process, name)
        # Attached before, so that nothing but the stop itself is between the clock's reading and the hang.
        ptrace(SEIZE, self.thread)

    def begin(self):
        ptrace(INTERRUPT, self.thread)

    def end(self):
        # The stop has to be seen before it can be ended. Nobody else may wait for the process in the meantime.
        os.waitpid(self.thread, WALL)
        ptrace(DETACH, self.thread)
