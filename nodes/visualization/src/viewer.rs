//! The page for browsers, seen from the node's thread: what is heard becomes what pages show ([`feed`], [`health`]), what
//! pages ask for becomes messages and calls ([`pointer`], [`parameters`]). Another thread talks to the pages ([`server`],
//! [`page`]); between the two stands [`link`]. What is said is written down in [`protocol`].

mod assets;
mod feed;
mod health;
mod link;
mod origin;
mod pace;
mod page;
mod parameters;
mod pointer;
mod protocol;
mod refusal;
mod server;

use std::hash::{BuildHasher, Hasher, RandomState};
use std::time::{Duration, Instant};

use node_kit::{Level, NodeKit, StartError, Status};
use scene::Scene;

use crate::inputs::Inputs;
use feed::Feed;
use health::Health;
use link::{Counts, NodeEnd, Page, Request};
use pace::Pace;
use parameters::NodeParameters;
use pointer::{PointerState, Pointers, Target};
use protocol::{Asked, Hello};
use server::Server;

/// Time between two looks at nodes and graph.
const HEALTH_PERIOD: Duration = Duration::from_millis(250);

/// The viewer, if the scene has one.
pub(crate) struct Viewer {
    running: Option<Running>,
}

struct Running {
    // Dropped first: its thread says goodbye while the other end is still there.
    server: Server,
    link: NodeEnd,
    scene: Scene,
    hello: Hello,
    /// Between two looks for something new.
    period: Duration,
    due: Instant,
    pace: Pace,
    health_due: Instant,
    /// Made for the first page.
    session: Option<Session>,
    pointers: Pointers,
    /// Pages had something to be shown at the last turn.
    is_shown: bool,
}

/// What is heard for pages only.
struct Session {
    feed: Feed,
    health: Health,
    parameters: NodeParameters,
}

impl Session {
    fn new(kit: &mut NodeKit, scene: &Scene) -> Result<Session, StartError> {
        Ok(Session {
            feed: Feed::new(kit, scene)?,
            health: Health::new(kit, &scene.session.devices)?,
            parameters: NodeParameters::new(kit)?,
        })
    }
}

impl Viewer {
    /// Serve the page, and say where.
    pub(crate) fn start(kit: &mut NodeKit, scene: &Scene) -> anyhow::Result<Viewer> {
        let settings = &scene.viewer;
        if !settings.enabled {
            return Ok(Viewer { running: None });
        }
        let (link, there) = link::link();
        let hello = hello(kit, scene);
        link.shown.send_modify(|shown| {
            shown.hello = protocol::hello(&hello).into();
            shown.chains.set(protocol::chains(scene.chains.as_ref()));
        });
        let server = Server::start(&settings.address, settings.port, settings.max_pages, there)?;
        kit.announce(&format!("viewer: {}", server.url()));
        if let Some(place) = server.for_other_machines() {
            kit.announce(&format!("viewer: {place}"));
        }
        let now = Instant::now();
        let running = Running {
            server,
            link,
            pointers: Pointers::new(hello.body_frame.clone(), &scene.session.devices),
            hello,
            scene: scene.clone(),
            period: period(scene),
            due: now,
            pace: Pace::default(),
            health_due: now,
            session: None,
            is_shown: false,
        };
        Ok(Viewer { running: Some(running) })
    }

    /// Wait, and pass on meanwhile what pages want of their pointers. Returns early when a page has come.
    pub(crate) fn wait(&mut self, kit: &mut NodeKit, until: Instant) -> anyhow::Result<()> {
        let Some(running) = &mut self.running else {
            std::thread::sleep(until.saturating_duration_since(Instant::now()));
            return Ok(());
        };
        while let Ok(request) = running.link.requests.recv_deadline(until) {
            match request {
                Request::Joined => return Ok(()),
                Request::Asked(page, asked) => running.answer(kit, page, asked)?,
            }
            // Pages that never stop asking do not hold up the turn.
            if Instant::now() >= until {
                break;
            }
        }
        Ok(())
    }

    /// When pages want to see something new; never without one.
    pub(crate) fn due(&self) -> Option<Instant> {
        let running = self.running.as_ref()?;
        (running.link.counts.pages() > 0).then_some(running.due)
    }

    /// Take over what arrived. True when more may wait.
    pub(crate) fn hear(&mut self, now: Instant) -> bool {
        let Some(session) = self.running.as_mut().and_then(|running| running.session.as_mut()) else {
            return false;
        };
        session.health.hear(now);
        session.parameters.hear(now);
        session.feed.hear()
    }

    /// Once a turn: show pages what is new, if there are any and it is time.
    pub(crate) fn turn(
        &mut self,
        kit: &mut NodeKit,
        now: Instant,
        inputs: &mut Inputs,
    ) -> anyhow::Result<()> {
        match &mut self.running {
            Some(running) => running.turn(kit, now, inputs),
            None => Ok(()),
        }
    }

    /// Take over parameters that were set while the node runs.
    pub(crate) fn retune(&mut self, scene: &Scene) {
        let Some(running) = &mut self.running else { return };
        running.period = period(scene);
        running.due = Instant::now();
        let chains_changed = running.scene.chains != scene.chains;
        running.scene = scene.clone();
        running.hello = of_scene(scene, &running.hello);
        running.link.shown.send_modify(|shown| {
            shown.hello = protocol::hello(&running.hello).into();
            if chains_changed {
                shown.chains.set(protocol::chains(scene.chains.as_ref()));
            }
        });
    }

    /// Where the page is.
    pub(crate) fn address(&self) -> Option<String> {
        self.running.as_ref().map(|running| running.server.url())
    }

    /// For diagnostics.
    pub(crate) fn status(&self) -> Option<Status> {
        let running = self.running.as_ref()?;
        let counts = &running.link.counts;
        let summary = if counts.pages() == 0 { "no page is open: nothing is computed" } else { "showing" };
        let status = Status::new(Level::Ok, "viewer", summary)
            .with("address", running.server.url())
            .with("pages", counts.pages())
            .with("sent_messages", Counts::of(&counts.sent))
            .with("dropped_updates", Counts::of(&counts.dropped))
            .with("refused", Counts::of(&counts.refused))
            .with("pointer_targets", running.pointers.targets());
        Some(status)
    }

    /// For the closing report.
    pub(crate) fn report(&self) -> serde_json::Value {
        let Some(running) = &self.running else { return serde_json::Value::Null };
        let counts = &running.link.counts;
        serde_json::json!({
            "sent_messages": Counts::of(&counts.sent),
            "dropped_updates": Counts::of(&counts.dropped),
            "refused": Counts::of(&counts.refused),
            "pointer_targets": running.pointers.targets(),
        })
    }

    /// Let go what pages hold.
    pub(crate) fn end(&mut self, kit: &mut NodeKit) -> anyhow::Result<()> {
        match &mut self.running {
            Some(running) => running.pointers.release_all(kit),
            None => Ok(()),
        }
    }
}

impl Running {
    fn answer(&mut self, kit: &mut NodeKit, page: Page, asked: Asked) -> anyhow::Result<()> {
        let now = Instant::now();
        match asked {
            Asked::PointerTake { device } => self.pointers.take(kit, now, page, &device),
            Asked::PointerRelease { device } => self.pointers.release(kit, &page, &device),
            Asked::PointerTarget { device, sequence, position, grasp } => {
                let target = Target { sequence, position_m: position, grasp };
                self.pointers.aim(kit, now, &page, &device, &target)
            }
            Asked::SetParameter { id, name, value } => {
                self.session(kit)?.parameters.ask(page, id, name, value);
                Ok(())
            }
            // Answered where it is heard, so that it measures the way and not the node.
            Asked::Ping { .. } => Ok(()),
        }
    }

    fn session(&mut self, kit: &mut NodeKit) -> Result<&mut Session, StartError> {
        let session = match self.session.take() {
            Some(session) => session,
            None => Session::new(kit, &self.scene)?,
        };
        Ok(self.session.insert(session))
    }

    fn turn(&mut self, kit: &mut NodeKit, now: Instant, inputs: &mut Inputs) -> anyhow::Result<()> {
        self.pointers.look_after(kit, now)?;
        if self.link.counts.pages() == 0 {
            self.clear();
            return Ok(());
        }
        if now < self.due {
            return Ok(());
        }
        // A turn that came late does not make the next ones hurry.
        self.due = (self.due + self.period).max(now);
        let lacks_it = self.session.as_ref().is_some_and(|session| session.feed.lacks_surface_of(inputs));
        if !self.pace.look(lacks_it || inputs.has_new_surface()) {
            return Ok(());
        }
        self.is_shown = true;
        inputs.hear_applied_forces(kit, &self.scene.session.devices)?;
        inputs.look_at_surface();
        inputs.look_at_devices();
        let ros_s = feed::ros_seconds(kit);
        let is_health_due = now >= self.health_due;
        let session = self.session(kit)?;
        if is_health_due {
            session.health.look_around(kit)?;
            session.parameters.set_present(kit, session.health.nodes())?;
        }
        session.parameters.advance(now);
        let parameters = session.parameters.news();
        let drivers = session.health.drivers(now);
        let update = session.feed.update(now, ros_s, inputs, &drivers);
        let status = if is_health_due { Some(self.health(kit, now, inputs)?) } else { None };
        if update.is_empty() && parameters.is_none() && status.is_none() {
            return Ok(());
        }
        self.link.shown.send_modify(|shown| {
            if let Some(parameters) = parameters {
                shown.parameters.set(protocol::parameters(&parameters));
            }
            if let Some(status) = status {
                shown.status.set(status);
            }
            update.apply(shown);
        });
        Ok(())
    }

    /// The status message.
    fn health(&mut self, kit: &mut NodeKit, now: Instant, inputs: &Inputs) -> anyhow::Result<String> {
        self.health_due = now + HEALTH_PERIOD;
        let views = inputs.views();
        let pointers: Result<Vec<PointerState>, _> =
            (0..views.len()).map(|device| self.pointers.state(kit, now, device)).collect();
        let (pointers, pages) = (pointers?, self.link.counts.pages());
        let session = self.session(kit)?;
        let unplaced = views.iter().map(|view| session.feed.unplaced(view, now)).collect();
        Ok(protocol::status(
            &session.health.statuses(now),
            &session.health.devices(now, views, &pointers, unplaced),
            &session.health.publishers(now, views),
            pages,
            inputs.not_drawn(),
        ))
    }

    /// Nobody looks: keep no picture.
    fn clear(&mut self) {
        if std::mem::take(&mut self.is_shown) {
            self.link
                .shown
                .send_modify(|shown| (shown.mesh, shown.surface, shown.state) = (None, None, None));
            if let Some(session) = &mut self.session {
                session.feed.forget();
            }
        }
    }
}

fn hello(kit: &NodeKit, scene: &Scene) -> Hello {
    let frames = Hello {
        namespace: kit.namespace().to_owned(),
        body_frame: kit.frame_id(&scene.body.frame_id),
        scene_frame: kit.frame_id(&scene.session.scene_frame_id),
        devices: scene.session.devices.clone(),
        probe_radius_m: 0.0,
        rate_hz: 0.0,
        full_scale_m: 0.0,
        force_scale_m_per_n: 0.0,
        displacement_scale: 0.0,
        // The seed of the standard library's hash maps, which differs from start to start.
        boot_id: format!("{:016x}", RandomState::new().build_hasher().finish()),
    };
    of_scene(scene, &frames)
}

/// With the numbers that the scene has now.
fn of_scene(scene: &Scene, hello: &Hello) -> Hello {
    Hello {
        probe_radius_m: scene.probe.radius_m,
        rate_hz: scene.viewer.rate_hz,
        full_scale_m: scene.visualization.full_scale_m,
        force_scale_m_per_n: scene.visualization.force_scale_m_per_n,
        displacement_scale: scene.visualization.displacement_scale,
        ..hello.clone()
    }
}

/// Time between two looks for something new. The schema has checked the rate.
fn period(scene: &Scene) -> Duration {
    Duration::try_from_secs_f64(1.0 / scene.viewer.rate_hz).unwrap_or(Duration::from_secs(1)) / Pace::LOOKS
}
