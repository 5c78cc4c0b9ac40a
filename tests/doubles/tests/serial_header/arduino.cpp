/* Runs the firmware until its line is gone. The clock starts 2 s before it wraps around. */
#include "Arduino.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

SerialPort Serial;

static uint32_t clock_us()
{
    timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint32_t)((uint64_t)now.tv_sec * 1000000u + (uint64_t)now.tv_nsec / 1000u);
}

uint32_t micros()
{
    static const uint32_t start = clock_us() + 2000000u;
    return clock_us() - start;
}

static int written[64];

static void changed(const char *what, uint8_t pin, int value)
{
    if (written[pin] != value)
        fprintf(stderr, "%s %d %d\n", what, pin, value);
    written[pin] = value;
}

void pinMode(uint8_t, int) {}
int digitalRead(uint8_t) { return HIGH; }
void digitalWrite(uint8_t pin, int value) { changed("digital", pin, value); }
void analogWrite(uint8_t pin, int value) { changed("analog", pin, value); }
int digitalPinToInterrupt(uint8_t pin) { return pin; }
void attachInterrupt(int, void (*)(), int) {}
void noInterrupts() {}
void interrupts() {}

void SerialPort::begin(unsigned long) { fcntl(0, F_SETFL, O_NONBLOCK); }

int SerialPort::available()
{
    int count = 0;
    if (ioctl(0, FIONREAD, &count) != 0)
        exit(0);
    return count;
}

int SerialPort::read()
{
    uint8_t byte;
    return ::read(0, &byte, 1) == 1 ? byte : -1;
}

int SerialPort::availableForWrite()
{
    pollfd line = {1, POLLOUT, 0};
    return poll(&line, 1, 0) == 1 && (line.revents & POLLOUT) != 0 ? 256 : 0;
}

size_t SerialPort::write(const uint8_t *bytes, size_t length)
{
    ssize_t count = ::write(1, bytes, length);
    if (count < 0 && errno != EAGAIN)
        exit(0);
    return count > 0 ? (size_t)count : 0;
}

int main()
{
    setup();
    for (;;) {
        loop();
        timespec pause = {0, 100000};
        nanosleep(&pause, NULL);
    }
}
