//! Buttons as CRTK's clients know them: pressed, released, and clicked for what was pressed only briefly.

/// A press that is shorter is a click as well, ns.
const CLICK_NS: u64 = 200_000_000;

/// `buttons[0]` of a Joy message.
pub(crate) const RELEASED: i32 = 0;
/// `buttons[0]` of a Joy message.
pub(crate) const PRESSED: i32 = 1;
/// `buttons[0]` of a Joy message; the release follows at once, so that the newest message is the button's state.
pub(crate) const CLICKED: i32 = 2;

/// One button.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Button {
    pressed: Option<bool>,
    since_ns: u64,
}

impl Button {
    /// What there is to say of the button now, oldest first. The first state is said, too.
    pub(crate) fn events(&mut self, pressed: bool, monotonic_ns: u64) -> &'static [i32] {
        let held_ns = monotonic_ns.saturating_sub(self.since_ns);
        if self.pressed == Some(pressed) {
            return &[];
        }
        let was_pressed = self.pressed == Some(true);
        *self = Button { pressed: Some(pressed), since_ns: monotonic_ns };
        match (pressed, was_pressed && held_ns < CLICK_NS) {
            (true, _) => &[PRESSED],
            (false, true) => &[CLICKED, RELEASED],
            (false, false) => &[RELEASED],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: u64 = 1_000_000;

    #[test]
    fn the_first_state_is_said_and_then_changes_only() {
        let mut button = Button::default();
        assert_eq!(button.events(false, MS), [RELEASED]);
        assert!(button.events(false, 2 * MS).is_empty());
        assert_eq!(button.events(true, 3 * MS), [PRESSED]);
        assert!(button.events(true, 900 * MS).is_empty());
        assert_eq!(button.events(false, 1000 * MS), [RELEASED], "a long press is no click");
    }

    #[test]
    fn a_short_press_is_a_click_that_ends_released() {
        let mut button = Button::default();
        button.events(true, 0);
        assert_eq!(button.events(false, 199 * MS), [CLICKED, RELEASED]);
        button.events(true, 500 * MS);
        assert_eq!(button.events(false, 700 * MS), [RELEASED]);
    }
}
