//! When pages are shown something new.

/// Keeps to `viewer.rate` on average, and shows a surface soon after it has come.
///
/// Surfaces at about the same rate come now a little early, now a little late. Looked for once in a period, one of them
/// would now and then be overtaken by the next before it was shown, and pages would get fewer than the model publishes.
/// So it is looked for twice in a period, and one that was late does not cost the one behind it its place.
#[derive(Debug, Default)]
pub(super) struct Pace {
    /// Half periods that were not used.
    saved: u8,
}

/// Half periods for one showing.
const PRICE: u8 = 2;
/// A showing that waits for a surface waits half a period.
const LONGEST_SAVED: u8 = PRICE + 1;

impl Pace {
    /// Looks in one period.
    pub(super) const LOOKS: u32 = PRICE as u32;

    /// One look: whether to show now what there is. `has_surface`: there is a surface that was not shown.
    pub(super) fn look(&mut self, has_surface: bool) -> bool {
        self.saved = (self.saved + 1).min(LONGEST_SAVED);
        let shows = self.saved >= PRICE && (has_surface || self.saved == LONGEST_SAVED);
        if shows {
            self.saved -= PRICE;
        }
        shows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Shown and overtaken of 1000 surfaces, one in a period of 2 looks, each up to `jitter` looks late.
    fn shown(jitter: f64) -> (usize, usize) {
        let mut pace = Pace::default();
        // Deterministic, and spread over all phases: the golden ratio.
        let arrivals: Vec<f64> =
            (0..1000).map(|n| f64::from(n) * 2.001 + jitter * (f64::from(n) * 0.618_034).fract()).collect();
        let (mut next, mut waiting, mut shown, mut overtaken) = (0, 0, 0, 0);
        for look in 0..2100 {
            while arrivals.get(next).is_some_and(|&at| at <= f64::from(look)) {
                (next, waiting) = (next + 1, waiting + 1);
            }
            if pace.look(waiting > 0) && waiting > 0 {
                (shown, overtaken, waiting) = (shown + 1, overtaken + waiting - 1, 0);
            }
        }
        (shown, overtaken)
    }

    #[test]
    fn of_surfaces_at_the_same_rate_none_is_overtaken_by_the_next() {
        // In half periods: up to 0.6 of 8 ms late at 60 Hz.
        assert_eq!(shown(0.0), (1000, 0));
        assert_eq!(shown(0.6), (1000, 0));
    }

    #[test]
    fn it_never_shows_more_often_than_asked_and_goes_on_without_surfaces() {
        let showings = |has_surface: bool| {
            let mut pace = Pace::default();
            (0..1000).filter(|_| pace.look(has_surface)).count()
        };
        assert_eq!(showings(true), 500);
        assert_eq!(showings(false), 499);
    }
}
