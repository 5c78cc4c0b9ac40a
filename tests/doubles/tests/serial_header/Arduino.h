/* As much of Arduino as the example firmware needs, on a machine with an operating system: Serial is standard input and
 * output, and what is written to pins goes to standard error, one line for each change. */
#ifndef ARDUINO_H
#define ARDUINO_H

#include <stddef.h>
#include <stdint.h>

enum { LOW, HIGH, INPUT, OUTPUT, INPUT_PULLUP, CHANGE };

uint32_t micros();
void pinMode(uint8_t pin, int mode);
int digitalRead(uint8_t pin);
void digitalWrite(uint8_t pin, int value);
void analogWrite(uint8_t pin, int value);
int digitalPinToInterrupt(uint8_t pin);
void attachInterrupt(int interrupt, void (*handler)(), int mode);
void noInterrupts();
void interrupts();

struct SerialPort {
    void begin(unsigned long baud);
    int available();
    int read();
    int availableForWrite();
    size_t write(const uint8_t *bytes, size_t length);
};
extern SerialPort Serial;

void setup();
void loop();

#endif
