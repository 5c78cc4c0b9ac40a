/* Reads a stream, says each frame again out of what it understood, and every other end with the frame {0xff}: what comes
 * back equal has been read and written by the header alone. */
#include <rhombus_serial.h>
#include <stdio.h>

static void say(const uint8_t *frame, size_t length)
{
    fwrite(frame, 1, length, stdout);
}

int main(void)
{
    static rhombus_receiver receiver;
    static uint8_t frame[RHOMBUS_MAX_FRAME];
    int byte;
    while ((byte = getchar()) != EOF) {
        const uint8_t *payload = NULL;
        size_t length = 0;
        rhombus_hello_request request;
        rhombus_command command;
        rhombus_hello hello;
        rhombus_state state;
        uint8_t joints;
        switch (rhombus_receive(&receiver, (uint8_t)byte, &payload, &length)) {
        case RHOMBUS_NOTHING:
            continue;
        case RHOMBUS_FRAME:
            if (rhombus_read_hello_request(payload, length, &request))
                say(frame, rhombus_write_hello_request(&request, frame));
            else if (rhombus_read_command(payload, length, &command))
                say(frame, rhombus_write_command(&command, frame));
            else if (rhombus_read_hello(payload, length, &hello))
                say(frame, rhombus_write_hello(&hello, frame));
            else if (rhombus_read_state(payload, length, &state, &joints))
                say(frame, rhombus_write_state(&state, joints, frame));
            else
                break;
            continue;
        case RHOMBUS_BAD_FRAME:
            break;
        }
        frame[1] = 0xff;
        say(frame, rhombus_finish_frame(frame, 1));
    }
    return 0;
}
