"""Whether the machine had time left. Where it had none, everybody waits for a processor, and nobody can be blamed; who waits
for somebody else leaves a processor idle."""

import time
from pathlib import Path

STEP_S = 0.02
# The kernel counts in 10 ms: a share is known to a sixth and better.
WINDOW_S = 0.06
# With less of all processors' time left, everybody waits.
BUSY = 0.25


def idle_s():
    """How long each processor has been idle since the machine started, on average, s."""
    first, *rest = Path("/proc/stat").read_text().splitlines()
    words = first.split()
    return (int(words[4]) + int(words[5])) / 100.0 / sum(line.startswith("cpu") for line in rest)


class Processors:
    """Looks every 20 ms at how much time is left."""

    def __init__(self):
        self.looks = []  # when, ns, and the idle time so far, s

    def watch(self, seconds):
        """Sleeps, and looks."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.looks.append((time.monotonic_ns(), idle_s()))
            time.sleep(STEP_S)

    def were_busy(self, begin_ns, end_ns):
        """Whether hardly any time was left, for 60 ms or longer, between two moments."""
        for number, (since_ns, idle) in enumerate(self.looks):
            later = next((look for look in self.looks[number:] if look[0] - since_ns >= WINDOW_S * 1e9), None)
            if later is None or later[0] < begin_ns or since_ns > end_ns:
                continue
            if later[1] - idle < BUSY * (later[0] - since_ns) / 1e9:
                return True
        return False
