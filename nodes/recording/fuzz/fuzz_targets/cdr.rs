//! Any bytes as each message: what decodes is encoded to bytes that decode to the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use recording::cdr::{Message, decode, encode};
use recording::messages::*;

fn check<M: Message>(bytes: &[u8]) {
    match decode::<M>(bytes) {
        Ok(message) => {
            let encoded = encode(&message);
            let again = decode::<M>(&encoded).expect("its own bytes");
            assert_eq!(encode(&again), encoded);
        }
        Err(error) => drop(error.to_string()),
    }
}

macro_rules! check_all {
    ($bytes:ident: $($message:ty),+ $(,)?) => { $(check::<$message>($bytes);)+ };
}

fuzz_target!(|bytes: &[u8]| {
    check_all!(bytes: Time, Duration, Clock, Header, Point, Vector3, Quaternion, Pose, PoseStamped, Transform, TransformStamped,
        TFMessage, Twist, TwistStamped, Wrench, WrenchStamped, Bool, UInt64, Joy, JointState, ContactState,
        SurfaceDisplacement, MeshTriangle, Mesh, ContactLaw);
});
