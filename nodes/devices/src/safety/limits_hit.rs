//! Which rules changed the force of a period.

/// A set of rules, one bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LimitsHit(u16);

impl LimitsHit {
    /// No rule.
    pub const NONE: LimitsHit = LimitsHit(0);
    /// The wanted wrench was not finite.
    pub const NOT_FINITE: LimitsHit = LimitsHit(1);
    /// The engage gate is closed: it waits for a wanted force near zero.
    pub const ENGAGE_GATE: LimitsHit = LimitsHit(1 << 1);
    /// The engage gate has opened and the force grows.
    pub const ENGAGE_RAMP: LimitsHit = LimitsHit(1 << 2);
    /// Outward force fades at the edge of the workspace.
    pub const WORKSPACE: LimitsHit = LimitsHit(1 << 3);
    /// The passivity controller took or added something.
    pub const PASSIVITY: LimitsHit = LimitsHit(1 << 4);
    /// The power was too large.
    pub const POWER: LimitsHit = LimitsHit(1 << 5);
    /// The force was too large.
    pub const FORCE: LimitsHit = LimitsHit(1 << 6);
    /// The torque was too large.
    pub const TORQUE: LimitsHit = LimitsHit(1 << 7);
    /// The gripper force was too large.
    pub const GRIPPER: LimitsHit = LimitsHit(1 << 8);
    /// The change was too fast.
    pub const SLEW: LimitsHit = LimitsHit(1 << 9);

    const NAMES: [(LimitsHit, &str); 10] = [
        (LimitsHit::NOT_FINITE, "not finite"),
        (LimitsHit::ENGAGE_GATE, "engage gate"),
        (LimitsHit::ENGAGE_RAMP, "engage ramp"),
        (LimitsHit::WORKSPACE, "workspace edge"),
        (LimitsHit::PASSIVITY, "passivity"),
        (LimitsHit::POWER, "power"),
        (LimitsHit::FORCE, "force"),
        (LimitsHit::TORQUE, "torque"),
        (LimitsHit::GRIPPER, "gripper force"),
        (LimitsHit::SLEW, "slew"),
    ];

    /// Whether every rule of `other` is in this set. RT safe.
    pub const fn contains(self, other: LimitsHit) -> bool {
        self.0 & other.0 == other.0
    }

    /// The bits, for an atomic or a counter for each rule: bit i is the i-th of [`names`](LimitsHit::names) of all.
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// The set with these bits; unknown ones are dropped.
    pub const fn from_bits(bits: u16) -> LimitsHit {
        LimitsHit(bits & ((1 << LimitsHit::NAMES.len()) - 1))
    }

    /// The rules of this set in words.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        LimitsHit::NAMES.into_iter().filter(move |(rule, _)| self.contains(*rule)).map(|(_, name)| name)
    }

    pub(super) fn insert(&mut self, rule: LimitsHit) {
        self.0 |= rule.0;
    }

    pub(super) fn insert_if(&mut self, hit: bool, rule: LimitsHit) {
        if hit {
            self.insert(rule);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_names_what_was_put_in_and_survives_its_bits() {
        let mut hit = LimitsHit::NONE;
        assert_eq!(hit.names().count(), 0);
        hit.insert(LimitsHit::SLEW);
        hit.insert_if(true, LimitsHit::POWER);
        hit.insert_if(false, LimitsHit::FORCE);
        assert_eq!(hit.names().collect::<Vec<_>>(), ["power", "slew"]);
        assert_eq!(LimitsHit::from_bits(hit.bits()), hit);
        assert_eq!(LimitsHit::from_bits(u16::MAX).names().count(), 10);
        for (bit, (rule, _)) in LimitsHit::NAMES.into_iter().enumerate() {
            assert_eq!(rule.bits(), 1 << bit);
        }
    }
}
