//! The report of `rhombus stability` for people.

use std::fmt::{self, Write};

use super::{Asked, Depths, Law, Report, SIMULATED};

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::new();
        let chains = self.chains.len();
        let plural = if chains == 1 { "chain" } else { "parallel chains" };
        writeln!(text, "contact law      {}, {chains} {plural}", self.formulation)?;
        law(&mut text, "together", &self.whole)?;
        if chains > 1 {
            for (index, chain) in self.chains.iter().enumerate() {
                law(&mut text, &format!("chain {index}"), chain)?;
            }
        }
        let Depths { pull_m, press_m } = &self.reach;
        writeln!(
            text,
            "within reach     {} to {}: as far as device.max_force = {} N goes",
            millimetres(*pull_m),
            millimetres(*press_m),
            self.largest_force_n
        )?;
        if self.motion_scale != 1.0 {
            writeln!(text, "motion scale     {} times the stiffness at the hand", self.motion_scale)?;
        }
        if self.largest_stiffness_factor != 1.0 {
            writeln!(text, "stiffness map    up to {} times as stiff", self.largest_stiffness_factor)?;
        }
        asked(&mut text, "only pressed", &self.pressed_only)?;
        asked(&mut text, "with a grasp", &self.with_grasp)?;
        writeln!(text, "loop             {} Hz, {} ms of delay", self.rate_hz, 1e3 * self.delay_s)?;
        writeln!(text, "damping needed   more than {:.4} N s/m", self.needed_damping_n_s_per_m)?;
        if let Some(device) = &self.device {
            let origin = match device.name.as_str() {
                SIMULATED => device.source.clone(),
                _ => format!("credited for the largest stiffness it is fit for; {}", device.source),
            };
            writeln!(
                text,
                "device           {}: {:.4} N s/m ({origin})",
                device.name, device.damping_n_s_per_m
            )?;
        }
        if let Some(stiffness) = self.largest_passive_stiffness_n_per_m {
            writeln!(text, "                 which is enough for {stiffness:.1} N/m")?;
        }
        writeln!(text, "verdict          {}", self.verdict)?;
        f.write_str(&text)
    }
}

fn law(text: &mut String, name: &str, law: &Law) -> fmt::Result {
    let depths = |Depths { pull_m, press_m }: &Depths| {
        format!("{} to {}", millimetres(*pull_m), millimetres(*press_m))
    };
    writeln!(
        text,
        "{name:<16} possible {}, guarded {}, {:.2} N/m at rest",
        depths(&law.possible),
        depths(&law.guarded),
        law.rest_stiffness_n_per_m
    )?;
    for range in &law.ranges {
        let way = match (range.bend, range.from_m, range.to_m) {
            ("straight", _, _) => format!("stays at {:.2} N/m", range.to_n_per_m),
            // From rest outwards, on both sides.
            (bend, Some(_), Some(to_m)) if to_m > 0.0 => {
                format!("{bend} from {:.2} to {:.2} N/m when pressed", range.from_n_per_m, range.to_n_per_m)
            }
            (bend, _, _) => {
                format!("{bend} from {:.2} to {:.2} N/m when pulled", range.to_n_per_m, range.from_n_per_m)
            }
        };
        writeln!(text, "    {:>12} to {:>12}  {way}", millimetres(range.from_m), millimetres(range.to_m))?;
    }
    Ok(())
}

fn asked(text: &mut String, name: &str, asked: &Asked) -> fmt::Result {
    let place = match asked.at {
        "lateral" => "across the grasp".to_owned(),
        "rest" => "at rest".to_owned(),
        _ => format!("at {}", millimetres(Some(asked.depth_m))),
    };
    writeln!(text, "{name:<16} at most {:.2} N/m at the hand, {place}", asked.stiffness_n_per_m)
}

fn millimetres(depth_m: Option<f64>) -> String {
    depth_m.map_or_else(|| "any depth".to_owned(), |depth_m| format!("{:.3} mm", 1e3 * depth_m))
}
