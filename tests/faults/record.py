"""What reached the motors: the record that a double writes, read while it grows."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Line:
    """One event at the motors; the force holds from then on."""

    t_ns: int  # CLOCK_MONOTONIC, as time.monotonic_ns()
    event: str  # enable, command, off, watchdog, velocity, gone
    force: tuple  # N
    torque: tuple  # N m
    grip_n: float
    commands: int  # that the driver has made so far, as far as the device can tell

    @property
    def size_n(self):
        return math.hypot(*self.force)

    @property
    def is_zero(self):
        return not any((*self.force, *self.torque, self.grip_n))


def parse(text):
    t_ns, event, *numbers, commands = text.split(",")
    numbers = tuple(float(number) for number in numbers)
    return Line(int(t_ns), event, numbers[:3], numbers[3:6], numbers[6], int(commands))


def change_n(before, after):
    return math.dist(before.force, after.force)


class Record:
    """A growing record."""

    def __init__(self, path):
        self.file = path.open()
        self.rest = ""
        self.lines = []
        self.header_is_read = False

    def read(self):
        """Takes in what is new; all lines so far."""
        text = self.rest + self.file.read()
        *complete, self.rest = text.split("\n")
        if complete and not self.header_is_read:
            self.header_is_read = True
            complete = complete[1:]
        for row in complete:
            self.lines.append(parse(row))
        return self.lines

    def since(self, t_ns):
        """Lines from a time on."""
        lines = self.read()
        begin = len(lines)
        while begin > 0 and lines[begin - 1].t_ns >= t_ns:
            begin -= 1
        return lines[begin:]

    def forget(self, t_ns):
        """Lets go of lines before a time."""
        self.lines = self.since(t_ns) or self.lines[-1:]

    def force_n(self):
        """The force on the hand now."""
        lines = self.read()
        return lines[-1].size_n if lines else 0.0
