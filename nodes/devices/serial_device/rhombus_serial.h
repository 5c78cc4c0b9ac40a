/* rhombus_serial.h: the serial protocol of Rhombus Haptics, version 1, for firmware of self-built devices.
 *
 * PROTOCOL.md says what the messages mean. C99 and C++11, no allocation, no dependency but the C library; every byte is
 * placed one by one, so neither the processor's byte order nor its alignment matters.
 *
 * Firmware mostly needs rhombus_device.h, which stands on this.
 *
 * SPDX-License-Identifier: Apache-2.0 OR MIT
 */
#ifndef RHOMBUS_SERIAL_H
#define RHOMBUS_SERIAL_H

#include <float.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define RHOMBUS_PROTOCOL_VERSION 1

/* Lengths of the payloads. A frame is 4 bytes longer. */
#define RHOMBUS_HELLO_REQUEST_LENGTH 2
#define RHOMBUS_COMMAND_LENGTH 32
#define RHOMBUS_HELLO_LENGTH 140
#define RHOMBUS_STATE_LENGTH 72 /* and 4 for each joint */
#define RHOMBUS_MAX_JOINTS 8
#define RHOMBUS_MAX_BUTTONS 16
#define RHOMBUS_NAME_LENGTH 32
#define RHOMBUS_FRAME_LENGTH(payload) ((payload) + 4)
/* The longest frame that is sent, a hello. */
#define RHOMBUS_MAX_FRAME RHOMBUS_FRAME_LENGTH(RHOMBUS_HELLO_LENGTH)

/* Types: the first byte of a payload. */
#define RHOMBUS_HELLO_REQUEST 0x01
#define RHOMBUS_COMMAND 0x02
#define RHOMBUS_HELLO 0x81
#define RHOMBUS_STATE 0x82

/* Bits of rhombus_hello.capabilities. */
#define RHOMBUS_HAS_FORCE 0x01u
#define RHOMBUS_HAS_TORQUE 0x02u
#define RHOMBUS_HAS_ORIENTATION 0x04u
#define RHOMBUS_HAS_GRIPPER 0x08u
#define RHOMBUS_HAS_GRIPPER_FORCE 0x10u
#define RHOMBUS_NEEDS_HOMING 0x20u
#define RHOMBUS_HAS_GRAVITY_COMPENSATION 0x40u

/* Bits of rhombus_command.flags. */
#define RHOMBUS_WANTS_MOTORS 0x01u
#define RHOMBUS_WANTS_HOME 0x02u
#define RHOMBUS_WANTS_GRAVITY_COMPENSATION 0x04u

/* Bits of rhombus_state.flags. */
#define RHOMBUS_MOTORS_ON 0x01u
#define RHOMBUS_HOMED 0x02u
#define RHOMBUS_HOMING 0x04u
#define RHOMBUS_COMMANDED 0x08u

/* Values of rhombus_state.cause: why the motors are off. */
#define RHOMBUS_CAUSE_NONE 0
#define RHOMBUS_CAUSE_COMMAND 1
#define RHOMBUS_CAUSE_WATCHDOG 2
#define RHOMBUS_CAUSE_VELOCITY 3
#define RHOMBUS_CAUSE_BUTTON 4
#define RHOMBUS_CAUSE_DEAD_MAN 5
#define RHOMBUS_CAUSE_EMERGENCY 6
#define RHOMBUS_CAUSE_OTHER 255

/* What the bytes below rely on. */
#define RHOMBUS_ASSERT(name, fact) typedef char rhombus_assert_##name[(fact) ? 1 : -1]
RHOMBUS_ASSERT(float_is_four_bytes, sizeof(float) == 4);
RHOMBUS_ASSERT(float_is_ieee_754, FLT_RADIX == 2 && FLT_MANT_DIG == 24 && FLT_MAX_EXP == 128);
RHOMBUS_ASSERT(bytes_have_eight_bits, sizeof(uint32_t) == 4);
RHOMBUS_ASSERT(a_hello_fits_one_block, RHOMBUS_HELLO_LENGTH + 2 < 254);
RHOMBUS_ASSERT(a_state_fits_one_block, RHOMBUS_STATE_LENGTH + 4 * RHOMBUS_MAX_JOINTS + 2 < 254);

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Messages: SI units, angles in rad, quaternions x y z w ------------------------------------------------------- */

typedef struct {
    uint8_t version; /* of the host */
} rhombus_hello_request;

typedef struct {
    uint8_t flags;
    uint16_t sequence;
    float force_n[3];
    float torque_n_m[3];
    float gripper_force_n; /* + opens */
} rhombus_command;

typedef struct {
    uint8_t version;
    uint8_t buttons;
    uint8_t joints;
    uint32_t capabilities;
    uint16_t watchdog_ms;
    uint16_t state_rate_hz;
    float max_force_n;
    float max_torque_n_m;
    float max_gripper_force_n;
    float workspace_centre_m[3];
    float workspace_radius_m;
    float workspace_height_m;
    char model[RHOMBUS_NAME_LENGTH]; /* printable ASCII, filled up with zeros; a full one has no zero */
    char serial[RHOMBUS_NAME_LENGTH];
    char firmware[RHOMBUS_NAME_LENGTH];
} rhombus_hello;

typedef struct {
    uint8_t flags;
    uint8_t cause;
    uint8_t lost_commands;
    uint16_t sequence;
    uint16_t command_sequence;
    uint32_t time_us;
    uint16_t command_age_us;
    uint16_t buttons;
    float position_m[3];
    float orientation[4];
    float linear_velocity_m_per_s[3];
    float angular_velocity_rad_per_s[3];
    float gripper_rad;
    float joints[RHOMBUS_MAX_JOINTS];
} rhombus_state;

/* ---- Bytes -------------------------------------------------------------------------------------------------------- */

/* CRC-16/IBM-3740 (CCITT-FALSE): polynomial 0x1021, start 0xffff; 0x29b1 for "123456789". */
static inline uint16_t rhombus_crc16(const uint8_t *bytes, size_t length)
{
    uint16_t crc = 0xffff;
    for (size_t i = 0; i < length; i++) {
        crc = (uint16_t)(crc ^ (uint16_t)((uint16_t)bytes[i] << 8));
        for (int bit = 0; bit < 8; bit++)
            crc = (uint16_t)((crc & 0x8000u) != 0 ? (uint16_t)(crc << 1) ^ 0x1021u : (uint16_t)(crc << 1));
    }
    return crc;
}

static inline uint8_t *rhombus_put_u16(uint8_t *to, uint16_t value)
{
    to[0] = (uint8_t)(value & 0xffu);
    to[1] = (uint8_t)(value >> 8);
    return to + 2;
}

static inline uint8_t *rhombus_put_u32(uint8_t *to, uint32_t value)
{
    return rhombus_put_u16(rhombus_put_u16(to, (uint16_t)(value & 0xffffu)), (uint16_t)(value >> 16));
}

static inline uint8_t *rhombus_put_floats(uint8_t *to, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        to = rhombus_put_u32(to, bits);
    }
    return to;
}

static inline const uint8_t *rhombus_get_u16(const uint8_t *from, uint16_t *value)
{
    *value = (uint16_t)(from[0] | (uint16_t)((uint16_t)from[1] << 8));
    return from + 2;
}

static inline const uint8_t *rhombus_get_u32(const uint8_t *from, uint32_t *value)
{
    *value = (uint32_t)from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24;
    return from + 4;
}

static inline const uint8_t *rhombus_get_floats(const uint8_t *from, float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        from = rhombus_get_u32(from, &bits);
        memcpy(&values[i], &bits, sizeof bits);
    }
    return from;
}

/* ---- Frames ------------------------------------------------------------------------------------------------------- */

/* Makes a frame of the payload that begins at frame[1]: adds the checksum behind it, stuffs it where it stands, and ends
 * it with the only 0. Returns the frame's length, payload + 4. */
static inline size_t rhombus_finish_frame(uint8_t *frame, size_t payload)
{
    rhombus_put_u16(frame + 1 + payload, rhombus_crc16(frame + 1, payload));
    size_t end = 1 + payload + 2;
    size_t code = 0;
    for (size_t i = 1; i < end; i++) {
        if (frame[i] == 0) {
            frame[code] = (uint8_t)(i - code);
            code = i;
        }
    }
    frame[code] = (uint8_t)(end - code);
    frame[end] = 0;
    return end + 1;
}

/* Finds frames in a stream of bytes. Set it to zeros before the first byte. */
typedef struct {
    uint8_t bytes[RHOMBUS_MAX_FRAME];
    uint16_t length;
    bool too_long;
} rhombus_receiver;

typedef enum {
    RHOMBUS_NOTHING,  /* no frame ends with this byte */
    RHOMBUS_FRAME,    /* receiver->bytes holds a payload of receiver->length bytes, until the next call */
    RHOMBUS_BAD_FRAME /* something ended here that is no frame */
} rhombus_received;

/* Takes one byte. After RHOMBUS_FRAME, *payload and *length are the payload. */
static inline rhombus_received rhombus_receive(rhombus_receiver *receiver, uint8_t byte, const uint8_t **payload,
                                               size_t *length)
{
    if (byte != 0) {
        if (receiver->length >= RHOMBUS_MAX_FRAME - 1)
            receiver->too_long = true;
        else
            receiver->bytes[receiver->length++] = byte;
        return RHOMBUS_NOTHING;
    }
    size_t stuffed = receiver->length;
    bool too_long = receiver->too_long;
    receiver->length = 0;
    receiver->too_long = false;
    if (too_long)
        return RHOMBUS_BAD_FRAME;
    if (stuffed == 0)
        return RHOMBUS_NOTHING;
    /* Each code says where the next one is, in the place of a 0. No frame is so long that a code is 255. */
    for (size_t code = 0; code < stuffed;) {
        size_t next = code + receiver->bytes[code];
        if (next > stuffed || receiver->bytes[code] == 255)
            return RHOMBUS_BAD_FRAME;
        receiver->bytes[code] = 0;
        code = next;
    }
    /* bytes[0] was the first code and is no data. */
    if (stuffed < 1 + 1 + 2)
        return RHOMBUS_BAD_FRAME;
    uint16_t crc;
    rhombus_get_u16(receiver->bytes + stuffed - 2, &crc);
    *payload = receiver->bytes + 1;
    *length = stuffed - 3;
    return rhombus_crc16(*payload, *length) == crc ? RHOMBUS_FRAME : RHOMBUS_BAD_FRAME;
}

/* ---- Writing messages: each returns the length of the frame, which must fit ---------------------------------------- */

static inline size_t rhombus_write_hello_request(const rhombus_hello_request *request, uint8_t *frame)
{
    frame[1] = RHOMBUS_HELLO_REQUEST;
    frame[2] = request->version;
    return rhombus_finish_frame(frame, RHOMBUS_HELLO_REQUEST_LENGTH);
}

static inline size_t rhombus_write_command(const rhombus_command *command, uint8_t *frame)
{
    uint8_t *to = frame + 1;
    *to++ = RHOMBUS_COMMAND;
    *to++ = command->flags;
    to = rhombus_put_u16(to, command->sequence);
    to = rhombus_put_floats(to, command->force_n, 3);
    to = rhombus_put_floats(to, command->torque_n_m, 3);
    rhombus_put_floats(to, &command->gripper_force_n, 1);
    return rhombus_finish_frame(frame, RHOMBUS_COMMAND_LENGTH);
}

static inline size_t rhombus_write_hello(const rhombus_hello *hello, uint8_t *frame)
{
    uint8_t *to = frame + 1;
    *to++ = RHOMBUS_HELLO;
    *to++ = hello->version;
    *to++ = hello->buttons;
    *to++ = hello->joints;
    to = rhombus_put_u32(to, hello->capabilities);
    to = rhombus_put_u16(to, hello->watchdog_ms);
    to = rhombus_put_u16(to, hello->state_rate_hz);
    to = rhombus_put_floats(to, &hello->max_force_n, 1);
    to = rhombus_put_floats(to, &hello->max_torque_n_m, 1);
    to = rhombus_put_floats(to, &hello->max_gripper_force_n, 1);
    to = rhombus_put_floats(to, hello->workspace_centre_m, 3);
    to = rhombus_put_floats(to, &hello->workspace_radius_m, 1);
    to = rhombus_put_floats(to, &hello->workspace_height_m, 1);
    memcpy(to, hello->model, RHOMBUS_NAME_LENGTH);
    memcpy(to + RHOMBUS_NAME_LENGTH, hello->serial, RHOMBUS_NAME_LENGTH);
    memcpy(to + 2 * RHOMBUS_NAME_LENGTH, hello->firmware, RHOMBUS_NAME_LENGTH);
    return rhombus_finish_frame(frame, RHOMBUS_HELLO_LENGTH);
}

/* With the first `joints` joints, at most RHOMBUS_MAX_JOINTS. */
static inline size_t rhombus_write_state(const rhombus_state *state, uint8_t joints, uint8_t *frame)
{
    uint8_t *to = frame + 1;
    if (joints > RHOMBUS_MAX_JOINTS)
        joints = RHOMBUS_MAX_JOINTS;
    *to++ = RHOMBUS_STATE;
    *to++ = state->flags;
    *to++ = state->cause;
    *to++ = state->lost_commands;
    to = rhombus_put_u16(to, state->sequence);
    to = rhombus_put_u16(to, state->command_sequence);
    to = rhombus_put_u32(to, state->time_us);
    to = rhombus_put_u16(to, state->command_age_us);
    to = rhombus_put_u16(to, state->buttons);
    to = rhombus_put_floats(to, state->position_m, 3);
    to = rhombus_put_floats(to, state->orientation, 4);
    to = rhombus_put_floats(to, state->linear_velocity_m_per_s, 3);
    to = rhombus_put_floats(to, state->angular_velocity_rad_per_s, 3);
    to = rhombus_put_floats(to, &state->gripper_rad, 1);
    rhombus_put_floats(to, state->joints, joints);
    return rhombus_finish_frame(frame, RHOMBUS_STATE_LENGTH + 4u * joints);
}

/* ---- Reading messages: false when the payload is another message or has the wrong length ---------------------------- */

static inline bool rhombus_read_hello_request(const uint8_t *payload, size_t length, rhombus_hello_request *request)
{
    if (length != RHOMBUS_HELLO_REQUEST_LENGTH || payload[0] != RHOMBUS_HELLO_REQUEST)
        return false;
    request->version = payload[1];
    return true;
}

static inline bool rhombus_read_command(const uint8_t *payload, size_t length, rhombus_command *command)
{
    if (length != RHOMBUS_COMMAND_LENGTH || payload[0] != RHOMBUS_COMMAND)
        return false;
    command->flags = payload[1];
    const uint8_t *from = rhombus_get_u16(payload + 2, &command->sequence);
    from = rhombus_get_floats(from, command->force_n, 3);
    from = rhombus_get_floats(from, command->torque_n_m, 3);
    rhombus_get_floats(from, &command->gripper_force_n, 1);
    return true;
}

static inline bool rhombus_read_hello(const uint8_t *payload, size_t length, rhombus_hello *hello)
{
    if (length != RHOMBUS_HELLO_LENGTH || payload[0] != RHOMBUS_HELLO)
        return false;
    hello->version = payload[1];
    hello->buttons = payload[2];
    hello->joints = payload[3];
    const uint8_t *from = rhombus_get_u32(payload + 4, &hello->capabilities);
    from = rhombus_get_u16(from, &hello->watchdog_ms);
    from = rhombus_get_u16(from, &hello->state_rate_hz);
    from = rhombus_get_floats(from, &hello->max_force_n, 1);
    from = rhombus_get_floats(from, &hello->max_torque_n_m, 1);
    from = rhombus_get_floats(from, &hello->max_gripper_force_n, 1);
    from = rhombus_get_floats(from, hello->workspace_centre_m, 3);
    from = rhombus_get_floats(from, &hello->workspace_radius_m, 1);
    from = rhombus_get_floats(from, &hello->workspace_height_m, 1);
    memcpy(hello->model, from, RHOMBUS_NAME_LENGTH);
    memcpy(hello->serial, from + RHOMBUS_NAME_LENGTH, RHOMBUS_NAME_LENGTH);
    memcpy(hello->firmware, from + 2 * RHOMBUS_NAME_LENGTH, RHOMBUS_NAME_LENGTH);
    return true;
}

/* *joints: how many came; the others are set to 0. */
static inline bool rhombus_read_state(const uint8_t *payload, size_t length, rhombus_state *state, uint8_t *joints)
{
    if (length < RHOMBUS_STATE_LENGTH || length > RHOMBUS_STATE_LENGTH + 4 * RHOMBUS_MAX_JOINTS || length % 4 != 0 ||
        payload[0] != RHOMBUS_STATE)
        return false;
    *joints = (uint8_t)((length - RHOMBUS_STATE_LENGTH) / 4);
    state->flags = payload[1];
    state->cause = payload[2];
    state->lost_commands = payload[3];
    const uint8_t *from = rhombus_get_u16(payload + 4, &state->sequence);
    from = rhombus_get_u16(from, &state->command_sequence);
    from = rhombus_get_u32(from, &state->time_us);
    from = rhombus_get_u16(from, &state->command_age_us);
    from = rhombus_get_u16(from, &state->buttons);
    from = rhombus_get_floats(from, state->position_m, 3);
    from = rhombus_get_floats(from, state->orientation, 4);
    from = rhombus_get_floats(from, state->linear_velocity_m_per_s, 3);
    from = rhombus_get_floats(from, state->angular_velocity_rad_per_s, 3);
    from = rhombus_get_floats(from, &state->gripper_rad, 1);
    for (size_t i = 0; i < RHOMBUS_MAX_JOINTS; i++)
        state->joints[i] = 0.0f;
    rhombus_get_floats(from, state->joints, *joints);
    return true;
}

#ifdef __cplusplus
}
#endif

#endif
