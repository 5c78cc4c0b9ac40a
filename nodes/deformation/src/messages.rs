//! The model's answers as messages. Each message is made once and filled again for every pose.

use glam::DVec3;
use node_kit::convert;
use r2r::geometry_msgs::msg::WrenchStamped;
use r2r::rhombus_haptics_msgs::msg::{ContactLaw, ContactState};
use r2r::std_msgs::msg::Header;
use rhombus_chain::{
    Answer, ChainParameters, ContactReport, Formulation, LAW_VALIDITY_NS, LocalLaw, Mode, Tissue,
    chain_for_hand,
};

/// The three messages that answer a pose.
pub(crate) struct Messages {
    pub(crate) force: WrenchStamped,
    pub(crate) law: ContactLaw,
    pub(crate) state: ContactState,
}

impl Messages {
    pub(crate) fn new(tissue: &Tissue, motion_scale: f64) -> Messages {
        let validity = convert::duration(LAW_VALIDITY_NS);
        let mut messages = Messages {
            force: WrenchStamped::default(),
            law: ContactLaw { validity, ..ContactLaw::default() },
            state: ContactState { barycentric: convert::three(DVec3::ZERO), ..ContactState::default() },
        };
        messages.set_chains(tissue, motion_scale);
        messages
    }

    /// The chains that the motor loop evaluates: for positions of the hand.
    pub(crate) fn set_chains(&mut self, tissue: &Tissue, motion_scale: f64) {
        let chains: Vec<ChainParameters> = tissue
            .law()
            .chains()
            .iter()
            .map(|chain| chain_for_hand(chain.parameters(), motion_scale))
            .collect();
        let each = |value: fn(&ChainParameters) -> f64| chains.iter().map(value).collect();
        let law = &mut self.law;
        law.formulation = match tissue.law().formulation() {
            Formulation::Published => ContactLaw::PUBLISHED as u8,
            Formulation::Energy => ContactLaw::ENERGY as u8,
        };
        law.rod_length = each(|chain| chain.rod_length_m);
        law.angle = each(|chain| chain.angle_rad);
        law.ratio = each(|chain| chain.ratio);
        law.units = chains.iter().map(|chain| chain.units).collect();
        law.normal_stiffness = each(|chain| chain.normal_stiffness_n_per_m);
        law.tangential_stiffness = each(|chain| chain.tangential_stiffness_n_per_m);
        law.tangential_growth = each(|chain| chain.tangential_growth);
    }

    /// The force on the hand; zero for a pose that was rejected.
    pub(crate) fn set_force(&mut self, header: &Header, answer: Option<&Answer>) {
        set_header(&mut self.force.header, header);
        let force_n = answer.map_or(DVec3::ZERO, |answer| answer.force_in_frame_n);
        self.force.wrench.force = convert::vector(force_n);
    }

    /// Law and state, in the frame of the pose; no contact for a pose that was rejected.
    pub(crate) fn set_contact(&mut self, header: &Header, answer: Option<&Answer>) {
        set_header(&mut self.law.header, header);
        set_header(&mut self.state.header, header);
        let law = answer.map_or(LocalLaw::default(), |answer| answer.law_for_hand);
        self.law.mode = mode_number(law.mode);
        self.law.anchor = convert::point(law.anchor);
        self.law.normal = convert::vector(law.normal);
        self.law.probe_radius = law.probe_radius_m;
        self.law.depth_offset = law.depth_offset_m;
        self.law.stiffness_factor = law.stiffness_factor;
        self.law.stiffness_gradient = convert::vector(law.stiffness_gradient_per_m);
        self.law.lateral_stiffness = law.lateral_stiffness_n_per_m;
        fill_state(&mut self.state, &answer.map_or(ContactReport::default(), ContactReport::from));
    }
}

fn set_header(target: &mut Header, source: &Header) {
    target.stamp.clone_from(&source.stamp);
    target.frame_id.clone_from(&source.frame_id);
}

fn mode_number(mode: Mode) -> u8 {
    match mode {
        Mode::None => ContactState::NONE as u8,
        Mode::Contact => ContactState::CONTACT as u8,
        Mode::Grasp => ContactState::GRASP as u8,
    }
}

fn fill_state(state: &mut ContactState, contact: &ContactReport) {
    state.mode = mode_number(contact.mode);
    state.saturated = contact.saturated;
    state.clutched = contact.clutched;
    state.face = contact.face;
    state.barycentric.copy_from_slice(&contact.barycentric.to_array());
    state.probe = convert::point(contact.probe);
    state.proxy = convert::point(contact.proxy);
    state.normal = convert::vector(contact.normal);
    state.depth = contact.depth_m;
    state.force = contact.force_n;
    state.stiffness = contact.stiffness_n_per_m;
}
