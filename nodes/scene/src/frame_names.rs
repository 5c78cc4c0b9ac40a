//! Frames: what a parameter means when it names one.

/// The frame a parameter means: a relative name gets the node's namespace in front ("/left" and "device_base" give
/// "left/device_base"), a leading "/" means the rest verbatim ("/PSM1_base" gives "PSM1_base").
pub fn frame_id(namespace: &str, parameter: &str) -> String {
    if let Some(verbatim) = parameter.strip_prefix('/') {
        return verbatim.to_owned();
    }
    match namespace.trim_matches('/') {
        "" => parameter.to_owned(),
        namespace => format!("{namespace}/{parameter}"),
    }
}

/// The namespace of the session that a device's driver works in: what stands before the name of its device, where
/// `devices` has that name ("/or/left" and ["left", "right"] give "/or"), else its own namespace.
pub fn session_namespace<'a>(namespace: &'a str, devices: &[String]) -> &'a str {
    let own = namespace.trim_end_matches('/');
    let names = devices.iter().map(|name| name.trim_end_matches('/'));
    let before = names
        .filter(|name| !name.is_empty() && !name.starts_with('/'))
        .find_map(|name| own.strip_suffix(name)?.strip_suffix('/'));
    match before {
        Some("") => "/",
        Some(session) => session,
        None => namespace,
    }
}

/// The frame that a parameter of one device means: "left" and "device_base" give "left/device_base" in "/", as the
/// device's own node would say it.
pub fn frame_id_of_device(namespace: &str, device: &str, parameter: &str) -> String {
    if device.starts_with('/') {
        return frame_id(device, parameter);
    }
    frame_id(&format!("{namespace}/{device}"), parameter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_frames_live_in_the_namespace_and_a_slash_means_verbatim() {
        assert_eq!(frame_id("/", "device_base"), "device_base");
        assert_eq!(frame_id("/left", "device_base"), "left/device_base");
        assert_eq!(frame_id("/room/left", "device_base"), "room/left/device_base");
        assert_eq!(frame_id("/left", "/PSM1_base"), "PSM1_base");
    }

    #[test]
    fn a_driver_finds_its_session_in_front_of_the_name_of_its_device() {
        let both = ["left", "right"].map(str::to_owned);
        assert_eq!(session_namespace("/left", &both), "/");
        assert_eq!(session_namespace("/or/right", &both), "/or");
        assert_eq!(session_namespace("/or/1/left", &["1/left/".to_owned()]), "/or");
        assert_eq!(session_namespace("/cleft", &both), "/cleft", "another name");
        assert_eq!(session_namespace("/or", &[String::new()]), "/or", "alone");
        assert_eq!(session_namespace("/", &both), "/");
    }

    #[test]
    fn a_devices_frame_is_the_one_its_own_node_would_name() {
        assert_eq!(frame_id_of_device("/", "left", "device_base"), "left/device_base");
        assert_eq!(frame_id_of_device("/or", "left", "device_base"), "or/left/device_base");
        assert_eq!(frame_id_of_device("/or", "", "device_base"), "or/device_base");
        assert_eq!(frame_id_of_device("/or", "/arm", "device_base"), "arm/device_base");
        assert_eq!(frame_id_of_device("/or", "left", "/world"), "world");
    }
}
