/* A planar pantograph with two motors, as a device of Rhombus Haptics.
 *
 * Two motors turn the upper arms, whose lower arms meet at the handle:
 *
 *            handle             x: to the right, y: away from the user, z: up, origin midway between the motors
 *            /    \             the handle moves in the plane z = 0
 *     lower /      \ lower
 *          /        \
 *   upper  \        /  upper
 *        motor 0  motor 1
 *
 * Needs a board whose USB port is its own (Teensy, RP2040, SAMD, ESP32-S3), a motor driver with PWM, direction and enable
 * inputs, and quadrature encoders. The driver's enable input has a pull-down resistor, so that a board that restarts or
 * hangs leaves the motors off; use your board's hardware watchdog too.
 *
 * SPDX-License-Identifier: Apache-2.0 OR MIT
 */
#include <rhombus_device.h>

/* ---- Your device: measure these ------------------------------------------------------------------------------------ */

static const float UPPER_ARM_M = 0.06f;
static const float LOWER_ARM_M = 0.09f;
static const float BETWEEN_MOTORS_M = 0.04f;
static const float COUNTS_PER_TURN = 4000.0f; /* of the encoder, all four edges */
/* Angles of the upper arms from +x, at rest against their stops when the board starts. */
static const float START_ANGLE_RAD[2] = {2.6f, 0.54f};
static const float MAX_FORCE_N = 3.0f;
static const float MAX_MOTOR_TORQUE_N_M = 0.15f;
static const float MAX_SPEED_M_PER_S = 1.5f; /* beyond it something is wrong: motors off */
static const uint8_t ENCODER_A[2] = {2, 4};
static const uint8_t ENCODER_B[2] = {3, 5};
static const uint8_t MOTOR_PWM[2] = {9, 10};
static const uint8_t MOTOR_DIRECTION[2] = {7, 8};
static const uint8_t MOTOR_ENABLE = 6;
static const uint8_t BUTTON = 12;

static const uint32_t STATE_PERIOD_US = 1000;
static const float VELOCITY_FILTER = 0.2f; /* share of the newest difference in each state: about 35 Hz at 1 kHz */

/* ---- State --------------------------------------------------------------------------------------------------------- */

static rhombus_device device;
static rhombus_state state;
static uint32_t state_us;
static volatile int32_t counts[2];

static void count(int motor)
{
    /* Called at both edges of A: B tells the direction. Two edges of four, so each counts twice. */
    bool a = digitalRead(ENCODER_A[motor]) == HIGH;
    bool b = digitalRead(ENCODER_B[motor]) == HIGH;
    counts[motor] += a == b ? -2 : 2;
}

static void count_0() { count(0); }
static void count_1() { count(1); }

/* ---- Mechanics ----------------------------------------------------------------------------------------------------- */

struct Mechanics {
    float angle[2];
    float elbow[2][2];
    float handle[2];
};

/* Where the handle is: where the lower arms' circles meet, on the far side. False in a position that cannot be. */
static bool forward(Mechanics *at)
{
    noInterrupts();
    int32_t now[2] = {counts[0], counts[1]};
    interrupts();
    for (int motor = 0; motor < 2; motor++) {
        float side = motor == 0 ? -0.5f : 0.5f;
        at->angle[motor] = START_ANGLE_RAD[motor] + 6.2831853f * (float)now[motor] / COUNTS_PER_TURN;
        at->elbow[motor][0] = side * BETWEEN_MOTORS_M + UPPER_ARM_M * cosf(at->angle[motor]);
        at->elbow[motor][1] = UPPER_ARM_M * sinf(at->angle[motor]);
    }
    float dx = at->elbow[1][0] - at->elbow[0][0];
    float dy = at->elbow[1][1] - at->elbow[0][1];
    float apart = sqrtf(dx * dx + dy * dy);
    float rise = LOWER_ARM_M * LOWER_ARM_M - 0.25f * apart * apart;
    if (apart < 1e-4f || rise <= 0.0f)
        return false;
    rise = sqrtf(rise) / apart;
    at->handle[0] = 0.5f * (at->elbow[0][0] + at->elbow[1][0]) - rise * dy;
    at->handle[1] = 0.5f * (at->elbow[0][1] + at->elbow[1][1]) + rise * dx;
    return true;
}

/* Torques that give a force at the handle: the transposed Jacobian, whose columns follow from the constant length of the
 * lower arms, lower[i] . (d handle - d elbow[i]) = 0. */
static bool torques(const Mechanics *at, const float *force_n, float *torque_n_m)
{
    float lower[2][2];
    for (int i = 0; i < 2; i++)
        for (int axis = 0; axis < 2; axis++)
            lower[i][axis] = at->handle[axis] - at->elbow[i][axis];
    float determinant = lower[0][0] * lower[1][1] - lower[0][1] * lower[1][0];
    /* Stretched arms: no torque gives that force. */
    if (fabsf(determinant) < 0.05f * LOWER_ARM_M * LOWER_ARM_M)
        return false;
    for (int i = 0; i < 2; i++) {
        float turn = UPPER_ARM_M * (lower[i][1] * cosf(at->angle[i]) - lower[i][0] * sinf(at->angle[i])) / determinant;
        float dx = i == 0 ? turn * lower[1][1] : -turn * lower[0][1];
        float dy = i == 0 ? -turn * lower[1][0] : turn * lower[0][0];
        torque_n_m[i] = force_n[0] * dx + force_n[1] * dy;
    }
    /* Both alike, so that the force keeps its direction. */
    float largest = fmaxf(fabsf(torque_n_m[0]), fabsf(torque_n_m[1]));
    for (int i = 0; i < 2 && largest > MAX_MOTOR_TORQUE_N_M; i++)
        torque_n_m[i] *= MAX_MOTOR_TORQUE_N_M / largest;
    return true;
}

/* At most MAX_MOTOR_TORQUE_N_M. */
static void drive(int motor, float torque_n_m)
{
    float share = torque_n_m / MAX_MOTOR_TORQUE_N_M;
    digitalWrite(MOTOR_DIRECTION[motor], share < 0.0f ? LOW : HIGH);
    analogWrite(MOTOR_PWM[motor], (int)(255.0f * fabsf(share) + 0.5f));
}

/* ---- Arduino ------------------------------------------------------------------------------------------------------- */

void setup()
{
    digitalWrite(MOTOR_ENABLE, LOW);
    pinMode(MOTOR_ENABLE, OUTPUT);
    for (int motor = 0; motor < 2; motor++) {
        pinMode(MOTOR_PWM[motor], OUTPUT);
        pinMode(MOTOR_DIRECTION[motor], OUTPUT);
        pinMode(ENCODER_A[motor], INPUT_PULLUP);
        pinMode(ENCODER_B[motor], INPUT_PULLUP);
        drive(motor, 0.0f);
    }
    pinMode(BUTTON, INPUT_PULLUP);
    attachInterrupt(digitalPinToInterrupt(ENCODER_A[0]), count_0, CHANGE);
    attachInterrupt(digitalPinToInterrupt(ENCODER_A[1]), count_1, CHANGE);

    rhombus_hello *hello = &device.hello;
    hello->version = RHOMBUS_PROTOCOL_VERSION;
    hello->buttons = 1;
    hello->joints = 2;
    hello->capabilities = RHOMBUS_HAS_FORCE;
    hello->watchdog_ms = RHOMBUS_WATCHDOG_MS;
    hello->state_rate_hz = (uint16_t)(1000000UL / STATE_PERIOD_US);
    hello->max_force_n = MAX_FORCE_N;
    hello->workspace_centre_m[1] = 0.11f;
    hello->workspace_radius_m = 0.035f;
    hello->workspace_height_m = 0.002f;
    strcpy(hello->model, "Pantograph");
    strcpy(hello->serial, "1");
    strcpy(hello->firmware, "1.0.0");

    state.orientation[3] = 1.0f;
    Serial.begin(921600);
}

void loop()
{
    static Mechanics at;
    static uint8_t frame[RHOMBUS_MAX_FRAME];

    /* What the host says. Only whole answers are sent, and only when they fit: this loop never waits. */
    while (Serial.available() > 0) {
        if (rhombus_device_receive(&device, (uint8_t)Serial.read(), micros()) == RHOMBUS_SEND_HELLO) {
            size_t length = rhombus_write_hello(&device.hello, frame);
            if (Serial.availableForWrite() >= (int)length)
                Serial.write(frame, length);
        }
    }
    rhombus_device_watch(&device, micros());

    /* The force, from where the handle is now. */
    float torque_n_m[2] = {0.0f, 0.0f};
    bool possible = forward(&at);
    if (device.motors_on && (!possible || !torques(&at, device.command.force_n, torque_n_m)))
        rhombus_switch_off(&device, RHOMBUS_CAUSE_OTHER);
    for (int motor = 0; motor < 2; motor++)
        drive(motor, device.motors_on ? torque_n_m[motor] : 0.0f);
    digitalWrite(MOTOR_ENABLE, device.motors_on ? HIGH : LOW);

    /* The state. */
    uint32_t now_us = micros();
    if (!device.greeted || !possible || now_us - state_us < STATE_PERIOD_US)
        return;
    float since_s = 1e-6f * (float)(now_us - state_us);
    state_us = now_us;
    float speed = 0.0f;
    for (int axis = 0; axis < 2; axis++) {
        float *velocity = &state.linear_velocity_m_per_s[axis];
        /* The first difference is from nowhere. */
        float newest = device.sequence > 0 ? (at.handle[axis] - state.position_m[axis]) / since_s : 0.0f;
        *velocity += VELOCITY_FILTER * (newest - *velocity);
        state.position_m[axis] = at.handle[axis];
        state.joints[axis] = at.angle[axis];
        speed += *velocity * *velocity;
    }
    if (device.motors_on && !(sqrtf(speed) <= MAX_SPEED_M_PER_S))
        rhombus_switch_off(&device, RHOMBUS_CAUSE_VELOCITY);
    state.buttons = digitalRead(BUTTON) == LOW ? 1 : 0;
    rhombus_device_state(&device, &state, RHOMBUS_HOMED, now_us);
    size_t length = rhombus_write_state(&state, device.hello.joints, frame);
    if (Serial.availableForWrite() >= (int)length)
        Serial.write(frame, length);
}
