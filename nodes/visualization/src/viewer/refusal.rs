//! A connection too many: it is told so and ended.

use std::time::Duration;

use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::time::timeout;

/// Longest time for telling it.
const PATIENCE: Duration = Duration::from_millis(500);

/// Answer whatever is asked with 503 and a sentence.
pub(crate) async fn refuse(mut stream: TcpStream, reason: &str) {
    let answer = format!(
        "HTTP/1.1 503 Service Unavailable\r\ncontent-type: text/plain; charset=utf-8\r\ncontent-length: {}\r\n\
         connection: close\r\nretry-after: 10\r\n\r\n{reason}\n",
        reason.len() + 1
    );
    let told = async {
        stream.write_all(answer.as_bytes()).await?;
        stream.shutdown().await?;
        // What is not read would take the answer back: a connection closed with bytes waiting is reset.
        let mut unread = [0_u8; 1024];
        while stream.read(&mut unread).await? > 0 {}
        Ok::<(), std::io::Error>(())
    };
    // Somebody who does not listen is not told.
    let _ = timeout(PATIENCE, told).await;
}
