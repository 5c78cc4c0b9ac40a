//! `rhombus_device.h`: when the motors are on, and with what force.

use devices::serial::wire::{self, Frame, HelloRequest};

use crate::{answer, c_program, hex};

/// A device by the header, which a script drives.
struct Scripted(Vec<String>);

impl Scripted {
    fn at(mut self, time_us: u32, frame: &Frame) -> Scripted {
        self.0.push(format!("{time_us} {}", hex(frame.bytes())));
        self
    }

    fn nothing_at(mut self, time_us: u32) -> Scripted {
        self.0.push(format!("{time_us} ."));
        self
    }

    fn off_at(mut self, time_us: u32) -> Scripted {
        self.0.push(format!("{time_us} off 5"));
        self
    }

    /// After each step: motors on, cause, commanded, lost commands, force x, action.
    fn run(self) -> Vec<[f64; 6]> {
        let folder = tempfile::tempdir().unwrap();
        let said = answer(&c_program(folder.path(), "device.c"), (self.0.join("\n") + "\n").as_bytes());
        let lines = String::from_utf8(said).unwrap();
        let numbers = |line: &str| line.split(' ').map(|n| n.parse().unwrap()).collect::<Vec<f64>>();
        lines.lines().map(numbers).map(|n| [n[1], n[2], n[3], n[4], n[6], n[13]]).collect()
    }
}

fn push(sequence: u16, flags: u8, force_x: f32) -> Frame {
    wire::Command { flags, sequence, force_n: [force_x, 0.0, 0.0], ..Default::default() }.frame()
}

#[test]
fn a_device_by_the_header_takes_the_force_away_after_20_ms_and_wants_to_be_asked_again() {
    let hello = HelloRequest { version: 1 }.frame();
    // Its clock wraps around on the way.
    let start = u32::MAX - 10_000;
    let at = |us: u32| start.wrapping_add(us);
    let said = Scripted(Vec::new())
        .at(at(0), &hello)
        .at(at(1000), &push(0, 1, 5.0))
        .nothing_at(at(20_999))
        .nothing_at(at(21_000))
        .at(at(22_000), &push(1, 1, 5.0))
        .at(at(23_000), &push(2, 0, 0.0))
        .at(at(24_000), &push(3, 1, 5.0))
        .off_at(at(25_000))
        .at(at(26_000), &push(4, 1, 5.0))
        .at(at(27_000), &hello)
        .at(at(28_000), &push(5, 1, 5.0))
        .at(at(29_000), &push(6, 0, 0.0))
        .at(at(30_000), &push(7, 1, 5.0))
        .run();
    let [off, command, watchdog, dead_man] = [0.0, 1.0, 2.0, 5.0];
    assert_eq!(
        said,
        [
            [0.0, off, 0.0, 0.0, 0.0, 1.0],
            [1.0, off, 1.0, 0.0, 5.0, 2.0],
            [1.0, off, 1.0, 0.0, 5.0, 0.0],
            [0.0, watchdog, 1.0, 0.0, 0.0, 0.0],
            [0.0, watchdog, 1.0, 0.0, 0.0, 2.0],
            [0.0, command, 1.0, 0.0, 0.0, 2.0],
            [1.0, off, 1.0, 0.0, 5.0, 2.0],
            [0.0, dead_man, 1.0, 0.0, 0.0, 0.0],
            [0.0, dead_man, 1.0, 0.0, 0.0, 2.0],
            // Whoever says hello has not said that the motors are to be off.
            [0.0, dead_man, 0.0, 0.0, 0.0, 1.0],
            [0.0, dead_man, 1.0, 0.0, 0.0, 2.0],
            [0.0, command, 1.0, 0.0, 0.0, 2.0],
            [1.0, off, 1.0, 0.0, 5.0, 2.0],
        ]
    );
}

#[test]
fn a_device_by_the_header_is_not_kept_pushing_by_a_line_that_repeats_itself() {
    let [newest, older] = [push(7, 1, 5.0), push(6, 1, 5.0)];
    let said = Scripted(Vec::new())
        .at(0, &newest)
        .at(10_000, &newest)
        .at(19_999, &older)
        .nothing_at(20_000)
        .at(21_000, &push(8, 0, 0.0))
        .at(22_000, &push(0x8000 + 8, 1, 5.0))
        .at(23_000, &push(0x8000 + 7, 1, 5.0))
        .run();
    let motors: Vec<f64> = said.iter().map(|said| said[0]).collect();
    assert_eq!(motors, [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    assert!(said.iter().take(5).all(|said| said[3] == 0.0), "and nothing of it was lost");
}

#[test]
fn a_device_by_the_header_gives_no_force_after_a_bad_frame_and_never_more_than_its_limit() {
    let bad = Frame::new(b"no message").unwrap();
    let said = Scripted(Vec::new())
        .at(0, &push(0, 1, 25.0))
        .at(1000, &bad)
        .at(2000, &push(1, 1, 5.0))
        .at(3000, &push(2, 1, f32::NAN))
        .at(4000, &push(5, 1, 5.0))
        .at(5000, &push(6, 1, f32::INFINITY))
        .at(6000, &push(7, 1, -f32::MAX))
        .run();
    let forces: Vec<f64> = said.iter().map(|said| said[4]).collect();
    assert_eq!(forces, [10.0, 0.0, 5.0, 0.0, 5.0, 0.0, 0.0]);
    let lost: Vec<f64> = said.iter().map(|said| said[3]).collect();
    // 2 was not taken, 3 and 4 never came.
    assert_eq!(lost, [0.0, 0.0, 0.0, 0.0, 3.0, 3.0, 3.0]);
    assert!(said.iter().all(|said| said[0] > 0.0), "the motors stay on");
}
