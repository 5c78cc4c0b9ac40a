/* rhombus_device.h: what the firmware of a device of Rhombus Haptics has to do, but for motors and sensors.
 *
 * It answers hello, obeys commands within the limits, counts what gets lost, and takes the force away when no command comes
 * for RHOMBUS_WATCHDOG_US. PROTOCOL.md says why. C99 and C++11, no allocation.
 *
 * SPDX-License-Identifier: Apache-2.0 OR MIT
 */
#ifndef RHOMBUS_DEVICE_H
#define RHOMBUS_DEVICE_H

#include <math.h>

#include "rhombus_serial.h"

#define RHOMBUS_WATCHDOG_MS 20
#define RHOMBUS_WATCHDOG_US (1000UL * RHOMBUS_WATCHDOG_MS)

#ifdef __cplusplus
extern "C" {
#endif

/* Set it to zeros, then set `hello`. Everything else is read only. */
typedef struct {
    rhombus_hello hello;
    rhombus_receiver receiver;
    bool greeted;   /* somebody has asked who it is: states may be sent */
    bool motors_on; /* switch the amplifiers accordingly, every time round */
    bool latched;   /* it has switched off itself; stays until a command without motors */
    uint8_t cause;
    bool commanded;          /* at least one good command since the hello */
    rhombus_command command; /* the newest good one, within the limits; no force unless motors_on */
    uint32_t command_us;     /* when it came */
    uint8_t lost_commands;
    uint32_t bad_frames;
    uint16_t sequence;
} rhombus_device;

/* What to do after a byte. */
typedef enum {
    RHOMBUS_GO_ON,
    RHOMBUS_SEND_HELLO, /* send rhombus_write_hello(&device->hello, ...) now */
    RHOMBUS_NEW_COMMAND /* device->command is new */
} rhombus_action;

static inline void rhombus_no_force(rhombus_command *command)
{
    for (int i = 0; i < 3; i++)
        command->force_n[i] = command->torque_n_m[i] = 0.0f;
    command->gripper_force_n = 0.0f;
}

/* The device takes its motors away: speed, dead man's switch, emergency stop, ... */
static inline void rhombus_switch_off(rhombus_device *device, uint8_t cause)
{
    device->motors_on = false;
    device->latched = true;
    device->cause = cause;
    rhombus_no_force(&device->command);
}

/* Scales a vector down to a length; false when it is not finite. */
static inline bool rhombus_limit(float *vector, int count, float longest)
{
    float sum = 0.0f;
    for (int i = 0; i < count; i++)
        sum += vector[i] * vector[i];
    /* A sum that overflows is a command that no host means. */
    if (!(sum <= FLT_MAX))
        return false;
    float length = sqrtf(sum);
    if (length > longest)
        for (int i = 0; i < count; i++)
            vector[i] *= longest / length;
    return true;
}

/* A frame that cannot be trusted: no force until the next good command. It does not feed the watchdog. */
static inline void rhombus_bad_frame(rhombus_device *device)
{
    device->bad_frames++;
    rhombus_no_force(&device->command);
}

static inline bool rhombus_obey(rhombus_device *device, rhombus_command command, uint32_t now_us)
{
    if (!rhombus_limit(command.force_n, 3, device->hello.max_force_n) ||
        !rhombus_limit(command.torque_n_m, 3, device->hello.max_torque_n_m) ||
        !rhombus_limit(&command.gripper_force_n, 1, device->hello.max_gripper_force_n)) {
        rhombus_bad_frame(device);
        return false;
    }
    if (device->commanded) {
        uint16_t ahead = (uint16_t)(command.sequence - device->command.sequence);
        /* A line that says something twice says nothing new, and the host may be gone. */
        if (ahead == 0 || ahead >= 0x8000u)
            return false;
        device->lost_commands = (uint8_t)(device->lost_commands + ahead - 1u);
    }
    device->commanded = true;
    device->command_us = now_us;
    device->command = command;
    if ((command.flags & RHOMBUS_WANTS_MOTORS) == 0) {
        device->motors_on = false;
        device->latched = false;
        device->cause = RHOMBUS_CAUSE_COMMAND;
    } else if (!device->latched) {
        device->motors_on = true;
        device->cause = RHOMBUS_CAUSE_NONE;
    }
    if (!device->motors_on)
        rhombus_no_force(&device->command);
    return true;
}

/* Takes one byte from the host. `now_us` is the device's clock, which may wrap around. */
static inline rhombus_action rhombus_device_receive(rhombus_device *device, uint8_t byte, uint32_t now_us)
{
    const uint8_t *payload = NULL;
    size_t length = 0;
    rhombus_hello_request request;
    rhombus_command command;
    switch (rhombus_receive(&device->receiver, byte, &payload, &length)) {
    case RHOMBUS_NOTHING:
        return RHOMBUS_GO_ON;
    case RHOMBUS_FRAME:
        if (rhombus_read_hello_request(payload, length, &request)) {
            /* Somebody new: motors off, whoever had them. What is latched stays latched. */
            device->greeted = true;
            device->motors_on = device->commanded = false;
            if (!device->latched)
                device->cause = RHOMBUS_CAUSE_NONE;
            rhombus_no_force(&device->command);
            return RHOMBUS_SEND_HELLO;
        }
        if (rhombus_read_command(payload, length, &command))
            return rhombus_obey(device, command, now_us) ? RHOMBUS_NEW_COMMAND : RHOMBUS_GO_ON;
        break;
    case RHOMBUS_BAD_FRAME:
        break;
    }
    rhombus_bad_frame(device);
    return RHOMBUS_GO_ON;
}

/* Call it every time round, at least 1000 times a second, whether bytes came or not: the watchdog. */
static inline void rhombus_device_watch(rhombus_device *device, uint32_t now_us)
{
    if (device->motors_on && (uint32_t)(now_us - device->command_us) >= RHOMBUS_WATCHDOG_US)
        rhombus_switch_off(device, RHOMBUS_CAUSE_WATCHDOG);
}

/* Fills in what the protocol wants of a state; sensors are yours. Call it once for each state that is sent. `homing` is
 * RHOMBUS_HOMED, RHOMBUS_HOMING or 0; a device that needs no homing says RHOMBUS_HOMED. */
static inline void rhombus_device_state(rhombus_device *device, rhombus_state *state, uint8_t homing, uint32_t now_us)
{
    uint32_t age_us = device->commanded ? (uint32_t)(now_us - device->command_us) : 0;
    state->flags = (uint8_t)(homing | (device->motors_on ? RHOMBUS_MOTORS_ON : 0u) |
                             (device->commanded ? RHOMBUS_COMMANDED : 0u));
    state->cause = device->cause;
    state->lost_commands = device->lost_commands;
    state->sequence = ++device->sequence;
    state->command_sequence = device->command.sequence;
    state->time_us = now_us;
    state->command_age_us = (uint16_t)(age_us < 65535u ? age_us : 65535u);
}

#ifdef __cplusplus
}
#endif

#endif
