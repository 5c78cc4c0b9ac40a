//! Baseline of the round trip: the least that an r2r node can do to answer a pose with a wrench.
//!
//! Same topics, types, QoS and loop as the deformation node (spin once, answer at once), and nothing else.

use std::time::Duration;

use futures::{FutureExt, StreamExt};
use r2r::QosProfile;
use r2r::geometry_msgs::msg::{PoseStamped, WrenchStamped};

fn main() -> anyhow::Result<()> {
    let context = r2r::Context::create()?;
    let mut node = r2r::Node::create(context, "bare_echo", "")?;
    let qos = || QosProfile::default().reliable().keep_last(1000);
    let mut poses = Box::pin(node.subscribe::<PoseStamped>("measured_cp", qos())?);
    let wrenches = node.create_publisher::<WrenchStamped>("servo_cf", qos())?;
    loop {
        node.spin_once(Duration::from_millis(10));
        while let Some(Some(pose)) = poses.next().now_or_never() {
            wrenches.publish(&WrenchStamped { header: pose.header, ..Default::default() })?;
        }
    }
}
