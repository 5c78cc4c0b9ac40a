//! Which devices these are: vendor and product ids, from PySpaceMouse's `devices.toml` and spacenavd's `src/dev.c`. Other
//! products under the same vendor ids (keypads, a mouse with a wheel) are not in it.

/// A product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Model {
    pub(super) vendor: u16,
    pub(super) product: u16,
    pub(super) name: &'static str,
    /// How many bits of the button report mean something.
    pub(super) buttons: usize,
}

const fn model(vendor: u16, product: u16, name: &'static str, buttons: usize) -> Model {
    Model { vendor, product, name, buttons }
}

/// All that are looked for.
pub(super) const MODELS: &[Model] = &[
    model(0x046d, 0xc626, "SpaceNavigator", 2),
    model(0x046d, 0xc627, "SpaceExplorer", 15),
    model(0x046d, 0xc628, "SpaceNavigator for Notebooks", 2),
    model(0x046d, 0xc629, "SpacePilot Pro", 31),
    model(0x046d, 0xc62b, "SpaceMouse Pro", 27),
    model(0x256f, 0xc62e, "SpaceMouse Wireless (cable)", 2),
    model(0x256f, 0xc62f, "SpaceMouse Wireless (receiver)", 2),
    model(0x256f, 0xc631, "SpaceMouse Pro Wireless (cable)", 27),
    model(0x256f, 0xc632, "SpaceMouse Pro Wireless (receiver)", 27),
    model(0x256f, 0xc633, "SpaceMouse Enterprise", 31),
    model(0x256f, 0xc635, "SpaceMouse Compact", 2),
    model(0x256f, 0xc636, "SpaceMouse Module", 2),
    model(0x256f, 0xc638, "SpaceMouse Pro Wireless (Bluetooth)", 27),
    model(0x256f, 0xc63a, "SpaceMouse Wireless (Bluetooth)", 2),
    model(0x256f, 0xc641, "SpaceMouse Module (USB)", 2),
    model(0x256f, 0xc652, "Universal Receiver", 27),
];

/// What a recording of reports is played back as.
pub(super) const RECORDED: Model = model(0, 0, "recorded SpaceMouse", 2);

/// The model with these ids.
pub(super) fn of(vendor: u16, product: u16) -> Option<Model> {
    MODELS.iter().copied().find(|model| (model.vendor, model.product) == (vendor, product))
}

/// All ids, for a message.
pub(super) fn ids() -> String {
    let ids: Vec<String> =
        MODELS.iter().map(|model| format!("{:04x}:{:04x}", model.vendor, model.product)).collect();
    ids.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_models_have_the_same_ids_and_no_button_is_beyond_the_mask() {
        for (at, model) in MODELS.iter().enumerate() {
            assert_eq!(of(model.vendor, model.product), Some(*model));
            assert!(MODELS[at + 1..].iter().all(|other| other.product != model.product));
            assert!(model.buttons <= 32);
        }
        assert_eq!(of(0x256f, 0xc650), None);
    }
}
