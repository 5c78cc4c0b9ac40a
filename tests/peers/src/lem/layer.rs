//! The static equations of a set of long elements, and their solution.
//!
//! Element i has cross-section A, rest length L_i and elongation x_i of its free end; neighbours are linked by the skin.
//! With external pressure p_i on its end, its equation of equilibrium (force on the end, outward positive) is
//!
//! ```text
//! A E x_i / L_i + sum_j tau (x_i - x_j) - A dP = -A p_i             Hooke, surface tension, Pascal
//! sum_i A x_i = 0                                                   the fluid keeps its volume
//! x_i = -d  for elements in rigid contact,  x_i = 0  for held ones
//! ```
//!
//! N + 1 equations for N elongations and the fluid's pressure change dP, the same everywhere. The first N are symmetric and
//! positive definite; they are solved by preconditioned conjugate gradients, once for the contact and once for dP = 1, and
//! dP follows from the last.

/// How an element's elongation is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// Nothing holds it.
    Free,
    /// It follows the rigid contact.
    Contact,
    /// It does not move.
    Held,
}

/// Whether the fluid keeps its volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fluid {
    /// It is confined: dP is what keeps the volume.
    Confined,
    /// The body is so large that dP = 0.
    Open,
}

/// Long elements side by side.
#[derive(Clone, Debug, Default)]
pub(super) struct Layer {
    /// Cross-section of every element, m^2.
    pub(super) area_m2: f64,
    /// E/L of each element, Pa/m.
    pub(super) stiffness_pa_per_m: Vec<f64>,
    /// The linked elements of each.
    pub(super) links: Vec<Vec<u32>>,
    pub(super) ends: Vec<End>,
    /// Surface tension tau: stiffness of a link, N/m.
    pub(super) tension_n_per_m: f64,
}

/// The answer of a layer.
#[derive(Clone, Debug, Default)]
pub(super) struct Equilibrium {
    /// Elongation of each element, m.
    pub(super) elongation_m: Vec<f64>,
    /// Pressure change of the fluid, Pa.
    pub(super) pressure_pa: f64,
    /// Force of the elements in contact on what touches them, N, outward.
    pub(super) force_n: f64,
}

/// Residual at which conjugate gradients stop, relative to the right-hand side.
const RESIDUAL: f64 = 1e-13;

impl Layer {
    /// The equilibrium when the contact is pressed in by `depth_m` and `pressure_pa` acts on all free ends.
    pub(super) fn solve(&self, depth_m: f64, pressure_pa: f64, fluid: Fluid) -> Equilibrium {
        let count = self.ends.len();
        let mut elongation_m: Vec<f64> =
            self.ends.iter().map(|end| if *end == End::Contact { -depth_m } else { 0.0 }).collect();
        let mut load = vec![0.0; count];
        self.forces(&elongation_m, &mut load);
        for load in &mut load {
            *load = -*load - self.area_m2 * pressure_pa;
        }
        let from_contact = self.conjugate_gradients(&load);
        let per_pascal = self.conjugate_gradients(&vec![self.area_m2; count]);
        for (x, found) in elongation_m.iter_mut().zip(&from_contact) {
            *x += found;
        }
        let room: f64 = per_pascal.iter().sum();
        let confined = fluid == Fluid::Confined && room > 0.0;
        let dp = if confined { -elongation_m.iter().sum::<f64>() / room } else { 0.0 };
        for (x, found) in elongation_m.iter_mut().zip(&per_pascal) {
            *x += dp * found;
        }
        self.forces(&elongation_m, &mut load);
        let touching =
            |(end, force): (&End, &f64)| (*end == End::Contact).then_some(self.area_m2 * dp - force);
        let force_n = self.ends.iter().zip(&load).filter_map(touching).sum();
        Equilibrium { elongation_m, pressure_pa: dp, force_n }
    }

    /// Force with which springs and skin pull each end inward, N.
    fn forces(&self, elongation_m: &[f64], forces: &mut [f64]) {
        for (i, force) in forces.iter_mut().enumerate() {
            let x = elongation_m[i];
            let skin: f64 = self.links[i].iter().map(|&j| x - elongation_m[j as usize]).sum();
            *force = self.area_m2 * self.stiffness_pa_per_m[i] * x + self.tension_n_per_m * skin;
        }
    }

    /// Solves the equations of the free elements for a load on their ends, N; the others stay at zero.
    fn conjugate_gradients(&self, load: &[f64]) -> Vec<f64> {
        let free = |i: usize| self.ends[i] == End::Free;
        let count = load.len();
        let diagonal = |i: usize| {
            self.area_m2 * self.stiffness_pa_per_m[i] + self.tension_n_per_m * self.links[i].len() as f64
        };
        let mut x = vec![0.0; count];
        let mut residual: Vec<f64> =
            load.iter().enumerate().map(|(i, &n)| if free(i) { n } else { 0.0 }).collect();
        let mut scaled: Vec<f64> = (0..count).map(|i| residual[i] / diagonal(i)).collect();
        let mut direction = scaled.clone();
        let mut product = vec![0.0; count];
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut size = dot(&residual, &scaled);
        let enough = size * RESIDUAL * RESIDUAL;
        for _ in 0..2 * count {
            if size <= enough {
                break;
            }
            self.forces(&direction, &mut product);
            for (i, product) in product.iter_mut().enumerate() {
                if !free(i) {
                    *product = 0.0;
                }
            }
            let along = size / dot(&direction, &product);
            for i in 0..count {
                x[i] += along * direction[i];
                residual[i] -= along * product[i];
                scaled[i] = residual[i] / diagonal(i);
            }
            let next = dot(&residual, &scaled);
            for (direction, scaled) in direction.iter_mut().zip(&scaled) {
                *direction = scaled + next / size * *direction;
            }
            size = next;
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::{End, Fluid, Layer};

    /// A square sheet of equal elements, linked to their four neighbours.
    fn sheet(side: u32, tension_n_per_m: f64) -> Layer {
        let count = (side * side) as usize;
        let mut links = vec![Vec::new(); count];
        for cell in 0..side * side {
            if cell % side + 1 < side {
                links[cell as usize].push(cell + 1);
                links[cell as usize + 1].push(cell);
            }
            if cell + side < side * side {
                links[cell as usize].push(cell + side);
                links[(cell + side) as usize].push(cell);
            }
        }
        Layer {
            area_m2: 4e-6,
            stiffness_pa_per_m: vec![10e3 / 0.05; count],
            links,
            ends: vec![End::Free; count],
            tension_n_per_m,
        }
    }

    #[test]
    fn volume_is_conserved_to_rounding_and_every_element_is_in_equilibrium() {
        let mut layer = sheet(21, 35.0);
        layer.ends[10 * 21 + 10] = End::Contact;
        layer.ends[0] = End::Held;
        let rest = layer.solve(0.003, 0.0, Fluid::Confined);
        let moved: f64 = rest.elongation_m.iter().map(|x| x.abs()).sum();
        assert!(rest.elongation_m.iter().sum::<f64>().abs() < 1e-13 * moved);
        assert!(rest.pressure_pa > 0.0 && rest.force_n > 0.0);
        assert_eq!(rest.elongation_m[0], 0.0);
        let mut forces = vec![0.0; 441];
        layer.forces(&rest.elongation_m, &mut forces);
        for (end, force) in layer.ends.iter().zip(forces) {
            let unbalanced = force - layer.area_m2 * rest.pressure_pa;
            assert!(*end != End::Free || unbalanced.abs() < 1e-10 * rest.force_n);
        }
        // Linear.
        let twice = layer.solve(0.006, 0.0, Fluid::Confined);
        assert!((twice.force_n / rest.force_n - 2.0).abs() < 1e-10);
    }

    #[test]
    fn uniform_pressure_shortens_all_elements_alike_or_is_borne_by_a_confined_fluid() {
        let layer = sheet(9, 35.0);
        let open = layer.solve(0.0, 500.0, Fluid::Open);
        assert!(open.elongation_m.iter().all(|x| (x + 500.0 * 0.05 / 10e3).abs() < 1e-15));
        let confined = layer.solve(0.0, 500.0, Fluid::Confined);
        assert!((confined.pressure_pa - 500.0).abs() < 1e-9);
        assert!(confined.elongation_m.iter().all(|x| x.abs() < 1e-15));
    }

    #[test]
    fn without_skin_a_pressed_element_is_a_rod() {
        let mut layer = sheet(5, 0.0);
        layer.ends[12] = End::Contact;
        let rod = layer.solve(0.001, 0.0, Fluid::Open);
        assert!((rod.force_n - 10e3 * 4e-6 * 0.001 / 0.05).abs() < 1e-15);
        assert_eq!(rod.elongation_m.iter().filter(|x| **x != 0.0).count(), 1);
    }
}
