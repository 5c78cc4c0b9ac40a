"""What people read of a session: a line while it runs, a table at its end."""


def live_line(plan, monitor, elapsed_s, duration_s):
    """One line that says how the session runs."""
    time = f"{elapsed_s:5.1f} s" if duration_s is None else f"{elapsed_s:5.1f} / {duration_s:.1f} s"
    parts = [time]
    for device, driver in zip(plan.devices, plan.drivers(0)):
        rate = monitor.value("deformation", "rate_hz", device.subject)
        depth = monitor.value("deformation", "depth_mm", device.subject)
        force = monitor.value("deformation", "force_n", device.subject)
        latency = monitor.value(driver.full_name, "latency_median_us")
        name = f"{device.name}: " if device.name else ""
        parts.append(f"{name}poses {rate} Hz   depth {depth} mm   force {force} N   latency {latency} us")
    return "   ".join(parts)


def number(source, key, digits=0):
    value = source.get(key)
    return "-" if value is None else f"{value:.{digits}f}"


def device_lines(driver, model):
    """Of one device: what its driver and the model say about it."""
    latency = driver.get("latency_us") or {}
    return [
        f"  poses sent            {number(driver, 'poses')}   ({number(driver, 'pose_rate_hz', 1)} Hz)",
        f"  forces received       {number(driver, 'forces')}   ({number(driver, 'force_rate_hz', 1)} Hz)",
        f"  poses unanswered      {number(driver, 'unanswered')}",
        f"  poses rejected        {number(model, 'rejected')}",
        f"  peak depth            {number(model, 'peak_depth_mm', 2)} mm",
        f"  peak force            {number(model, 'peak_force_n', 3)} N",
        f"  pose to force         median {number(latency, 'median')} us, p99 {number(latency, 'p99')} us, "
        f"max {number(latency, 'max')} us",
        f"  answered in           median {number(model, 'step_median_us', 1)} us, p99 {number(model, 'step_p99_us', 1)} us "
        "(in the model node: pose taken to force sent)",
        f"  missed deadlines      {number(driver, 'missed_deadlines')} (force later than one period), "
        f"{number(driver, 'late_ticks')} late ticks of the motor loop",
    ]


def summary(plan, reports, recording):
    """The closing reports as a short plain-text table. `reports` has one for each label of a node."""
    model, view, recorder = (reports.get(name, {}) for name in ("deformation", "visualization", "recorder"))
    lines = ["session summary"]
    for device in plan.devices:
        if device.name:
            serial = f" {device.serial}" if device.serial else ""
            lines.append(f"{device.name} ({device.backend}{serial})")
        of_model = model.get("devices", {}).get(device.subject, {})
        lines += device_lines(reports.get(device.label, {}), of_model)
    if len(plan.devices) > 1:
        lines.append("all")
    lines.append(f"  surfaces published    {number(model, 'surfaces')}")
    lines.append(f"  markers published     {number(view, 'markers')}")
    if recording:
        lines.append(f"  messages recorded     {number(recorder, 'messages')}")
        lines.append(f"recording: recordings/{recording}")
    else:
        lines.append("recording: none (--no-record)")
    return "\n".join(lines)
