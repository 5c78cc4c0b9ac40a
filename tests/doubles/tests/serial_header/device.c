/* Runs rhombus_device on a script: lines `TIME_US HEX`, bytes that come at a time, or `TIME_US off CAUSE`. After each it
 * says: greeted motors cause commanded lost_commands bad_frames fx fy fz tx ty tz grip action. */
#include <rhombus_device.h>
#include <stdio.h>

int main(void)
{
    static rhombus_device device;
    char words[1024];
    unsigned long time_us;
    device.hello.max_force_n = 10.0f;
    device.hello.max_torque_n_m = 0.5f;
    device.hello.max_gripper_force_n = 4.0f;
    while (scanf("%lu %1023[^\n]", &time_us, words) == 2) {
        uint32_t now_us = (uint32_t)time_us;
        rhombus_action action = RHOMBUS_GO_ON;
        unsigned number;
        if (sscanf(words, "off %u", &number) == 1) {
            rhombus_switch_off(&device, (uint8_t)number);
        } else {
            const char *hex = words;
            while (sscanf(hex, "%2x", &number) == 1) {
                rhombus_action now = rhombus_device_receive(&device, (uint8_t)number, now_us);
                if (now != RHOMBUS_GO_ON)
                    action = now;
                hex += 2;
            }
        }
        rhombus_device_watch(&device, now_us);
        const rhombus_command *command = &device.command;
        printf("%d %d %d %d %d %lu %g %g %g %g %g %g %g %d\n", device.greeted, device.motors_on, device.cause,
               device.commanded, device.lost_commands, (unsigned long)device.bad_frames, (double)command->force_n[0],
               (double)command->force_n[1], (double)command->force_n[2], (double)command->torque_n_m[0],
               (double)command->torque_n_m[1], (double)command->torque_n_m[2], (double)command->gripper_force_n,
               (int)action);
        fflush(stdout);
    }
    return 0;
}
