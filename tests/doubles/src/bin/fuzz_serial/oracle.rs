//! Another decoder, as slow and plain as can be, and nothing of the backend in it.

/// What stands between two zeros: a payload, or none. Nothing at all between them is nothing.
pub(crate) fn frames(stream: &[u8]) -> Vec<Option<Vec<u8>>> {
    let mut parts: Vec<&[u8]> = stream.split(|&byte| byte == 0).collect();
    // What follows the last zero goes on.
    parts.pop();
    parts.into_iter().filter(|part| !part.is_empty()).map(payload).collect()
}

fn payload(stuffed: &[u8]) -> Option<Vec<u8>> {
    const LONGEST: usize = 254;
    if stuffed.len() > LONGEST {
        return None;
    }
    let mut plain = Vec::new();
    let mut rest = stuffed;
    while let Some((&code, after)) = rest.split_first() {
        let block = after.get(..usize::from(code) - 1)?;
        plain.extend(block);
        rest = &after[block.len()..];
        if code != 255 && !rest.is_empty() {
            plain.push(0);
        }
    }
    let (payload, sum) = plain.split_last_chunk::<2>()?;
    (!payload.is_empty() && crc(payload) == u16::from_le_bytes(*sum)).then(|| payload.to_vec())
}

/// The checksum bit by bit: polynomial 0x1021 from 0xffff.
fn crc(payload: &[u8]) -> u16 {
    let mut register = 0xffff_u16;
    for byte in payload {
        for bit in (0..8).rev() {
            let out = (register >> 15) ^ u16::from((byte >> bit) & 1);
            register = (register << 1) ^ (out * 0x1021);
        }
    }
    register
}
