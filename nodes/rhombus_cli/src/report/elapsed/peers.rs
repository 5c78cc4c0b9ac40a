//! The same journey with peers: pressed at a place, elsewhere, and back again.

use std::path::Path;

use glam::DVec3;
use rhombus_peers::PeerKind;
use scene::{Site, sites};

use crate::report::section::Exhibit;
use crate::report::stability_map::{Liver, Random};
use crate::report::table::{Cell, Table};

/// Peers that are set up in seconds.
const NAMES: [&str; 4] = ["condensed FEM, 1st order, full product", "mass-spring", "S-chain", "LEM"];
const VERTICES: usize = 500;
const PLACES: usize = 4;
const DEPTH_M: f64 = 0.004;
/// Periods of 1 ms in which the disc goes down, stays, and comes back up.
const PHASE: usize = 40;

/// Drift of each peer over so many visits, compared with its first answer at each place.
pub(super) fn drift(reference: &Path, visits: usize, step: impl Fn(&str)) -> anyhow::Result<Exhibit> {
    let liver = Liver::read(reference, VERTICES)?;
    let places = sites(&liver.body, PLACES);
    let mut table = Table::new([
        ("peer", ""),
        ("returns", ""),
        ("periods of 1 ms", ""),
        ("drift of force", "N"),
        ("force", "N"),
        ("drift of field", "m"),
    ]);
    for kind in rhombus_peers::all().iter().filter(|kind| NAMES.contains(&kind.name)) {
        step(kind.name);
        table.push(row(kind, &liver, &places, visits)?);
    }
    Ok(Exhibit {
        name: "elapsed_peers",
        title: "Drift of peers".to_owned(),
        caption: format!(
            "The {VERTICES}-vertex liver, a disc of 5 mm pressed 4 mm deep in 40 ms and held for 40 ms at one of {PLACES} places, \
             taken away in 40 ms, pressed elsewhere: largest difference of force and of any vertex from the first answer at the \
             place. Models that solve for equilibrium have none; those that step through time carry their past along."
        ),
        figure: None,
        table,
        raw: None,
    })
}

fn row(kind: &PeerKind, liver: &Liver, places: &[Site], visits: usize) -> anyhow::Result<Vec<Cell>> {
    let mut peer = (kind.setup)(&liver.job(10e3))?;
    let mut random = Random::new(1);
    let mut now = vec![DVec3::ZERO; liver.body.mesh().vertices().len()];
    let mut first: Vec<Option<(f64, Vec<DVec3>)>> = vec![None; places.len()];
    let (mut returns, mut periods, mut force_drift_n, mut field_drift_m, mut largest_n) =
        (0_u64, 0_u64, 0.0, 0.0, 0.0_f64);
    let larger = |most: f64, difference: f64| if difference <= most { most } else { difference };
    for _ in 0..visits {
        let place = random.below(places.len());
        peer.touch(places[place].vertex, places[place].normal);
        let mut force_n = 0.0;
        for period in 1..=2 * PHASE {
            force_n = peer.query(DEPTH_M * period.min(PHASE) as f64 / PHASE as f64, &mut now);
        }
        largest_n = largest_n.max(force_n.abs());
        match &first[place] {
            None => first[place] = Some((force_n, now.clone())),
            Some((first_n, field)) => {
                returns += 1;
                force_drift_n = larger(force_drift_n, (force_n - first_n).abs());
                let differences = now.iter().zip(field).map(|(now, first)| (*now - *first).length());
                field_drift_m = larger(field_drift_m, differences.fold(0.0, larger));
            }
        }
        for period in (0..PHASE).rev() {
            peer.query(DEPTH_M * period as f64 / PHASE as f64, &mut now);
        }
        periods += 3 * PHASE as u64;
    }
    Ok(vec![
        kind.name.into(),
        Cell::Count(returns),
        Cell::Count(periods),
        force_drift_n.into(),
        largest_n.into(),
        field_drift_m.into(),
    ])
}
