//! The thread that writes: everything comes to it through one queue and is stored in that order.
//!
//! The queue is bounded and a full one holds up the receiving side, where rcl keeps some more seconds of messages: a disk
//! that pauses loses nothing, and one that stops for good does not eat the memory.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use anyhow::{Context, anyhow};
use crossbeam::channel::{Receiver, RecvTimeoutError, Sender, bounded};
use recording::{DefinitionError, MessageDefinition, Qos, Topic, TopicId, Writer, Written};

use crate::batch::Batch;

/// Half a minute of a session with two devices.
const QUEUE_BYTES: usize = 64 << 20;
/// The same for messages that are small or have no content.
const QUEUE_BATCHES: usize = 4096;
/// How often a full queue is looked at.
const FULL: Duration = Duration::from_millis(2);
/// Without new messages what was received goes to the file after this long.
const IDLE: Duration = Duration::from_millis(250);

/// Finds the text of a type. It reads files, which may take its time: the receiving side must not wait for it.
type FindDefinition = dyn Fn(&str) -> Result<MessageDefinition, DefinitionError> + Send;

enum Job {
    /// The next topic; they are numbered in the order in which they come.
    Topic {
        name: String,
        type_name: String,
        offered_qos: Vec<Qos>,
    },
    Messages(Batch),
}

/// The receiving side's end of the queue.
pub(crate) struct Storage {
    jobs: Sender<Job>,
    thread: JoinHandle<anyhow::Result<Written>>,
    /// Bytes of the messages in the queue.
    waiting: Arc<AtomicUsize>,
    topics: usize,
    messages: u64,
    held_up: u64,
}

impl Storage {
    /// Starts the thread. A topic whose type has no definition is recorded without one, and `warn` is told.
    pub(crate) fn start(
        writer: Writer,
        find_definition: Box<FindDefinition>,
        warn: Box<dyn Fn(&str) + Send>,
    ) -> anyhow::Result<Self> {
        let (jobs, queue) = bounded(QUEUE_BATCHES);
        let waiting = Arc::new(AtomicUsize::new(0));
        let written = Arc::clone(&waiting);
        let definition_of = move |name: &str, type_name: &str| {
            find_definition(type_name).unwrap_or_else(|error| {
                warn(&format!("{name} is recorded without the text of its type: {error}"));
                MessageDefinition::default()
            })
        };
        let thread = std::thread::Builder::new()
            .name("bag_writer".to_owned())
            .spawn(move || write(writer, &queue, &written, definition_of));
        let thread = thread.context("the writing thread")?;
        Ok(Self { jobs, thread, waiting, topics: 0, messages: 0, held_up: 0 })
    }

    /// Adds a topic and gives its number.
    pub(crate) fn add_topic(&mut self, name: &str, type_name: &str, offered_qos: Vec<Qos>) -> usize {
        self.send(Job::Topic { name: name.to_owned(), type_name: type_name.to_owned(), offered_qos });
        self.topics += 1;
        self.topics - 1
    }

    /// Stores messages; waits while the queue is full.
    pub(crate) fn store(&mut self, batch: Batch) {
        if self.waiting.load(Ordering::Relaxed) > QUEUE_BYTES || self.jobs.is_full() {
            self.held_up += 1;
        }
        while self.waiting.load(Ordering::Relaxed) > QUEUE_BYTES && !self.has_failed() {
            std::thread::sleep(FULL);
        }
        self.waiting.fetch_add(batch.bytes(), Ordering::Relaxed);
        self.messages += batch.len() as u64;
        self.send(Job::Messages(batch));
    }

    /// Messages given to the thread so far.
    pub(crate) fn messages(&self) -> u64 {
        self.messages
    }

    /// Bytes of messages that wait to be written.
    pub(crate) fn queued_bytes(&self) -> usize {
        self.waiting.load(Ordering::Relaxed)
    }

    /// How often the queue was full.
    pub(crate) fn held_up(&self) -> u64 {
        self.held_up
    }

    /// Whether the thread ended early, which it does only when writing fails; [`Storage::finish`] tells why.
    pub(crate) fn has_failed(&self) -> bool {
        self.thread.is_finished()
    }

    /// Lets the thread write what is queued and close the recording.
    pub(crate) fn finish(self) -> anyhow::Result<Written> {
        drop(self.jobs);
        self.thread.join().map_err(|_| anyhow!("the writing thread panicked"))?
    }

    /// A thread that is gone is noticed by `has_failed`; what is sent to it goes nowhere.
    fn send(&mut self, job: Job) {
        let _ = self.jobs.send(job);
    }
}

fn write(
    mut writer: Writer,
    queue: &Receiver<Job>,
    waiting: &AtomicUsize,
    definition_of: impl Fn(&str, &str) -> MessageDefinition,
) -> anyhow::Result<Written> {
    let mut topics: Vec<TopicId> = Vec::new();
    loop {
        match queue.recv_timeout(IDLE) {
            Ok(Job::Topic { name, type_name, offered_qos }) => {
                let definition = definition_of(&name, &type_name);
                let serialization_format = "cdr".to_owned();
                let topic = Topic { name, type_name, serialization_format, offered_qos, definition };
                topics.push(writer.add_topic(topic)?);
            }
            Ok(Job::Messages(batch)) => {
                for (topic, log_time_ns, data) in batch.messages() {
                    let topic =
                        topics.get(topic).ok_or_else(|| anyhow!("a message came before its topic"))?;
                    writer.write(*topic, log_time_ns, data)?;
                }
                waiting.fetch_sub(batch.bytes(), Ordering::Relaxed);
            }
            Err(RecvTimeoutError::Timeout) => writer.flush()?,
            Err(RecvTimeoutError::Disconnected) => return Ok(writer.close()?),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use recording::{MessageDefinitions, Recording};

    fn start(directory: &std::path::Path) -> (Storage, Receiver<String>) {
        let writer = Writer::create(directory, "").unwrap();
        let nowhere = MessageDefinitions::new(Vec::new());
        let (warnings, warned) = bounded(10);
        let warn = move |text: &str| warnings.send(text.to_owned()).unwrap();
        (Storage::start(writer, Box::new(move |name| nowhere.get(name)), Box::new(warn)).unwrap(), warned)
    }

    #[test]
    fn everything_is_stored_in_order_although_the_queue_gets_full() {
        let directory = std::env::temp_dir().join(format!("bag_replay_storage_{}", std::process::id()));
        let (mut storage, warned) = start(&directory);
        let number = storage.add_topic("/a", "std_msgs/msg/Bool", Vec::new());
        let large = vec![7; 1 << 20];
        let count = 2 * (QUEUE_BYTES >> 20) as u64 + 10;
        for i in 0..count {
            let mut batch = Batch::default();
            batch.push(number, i, &[&i.to_le_bytes()[..], &large].concat());
            storage.store(batch);
        }
        assert_eq!(storage.messages(), count);
        let written = storage.finish().unwrap();
        assert!(warned.recv().unwrap().contains("/a is recorded without the text of its type"));
        let recording = Recording::open(&directory).unwrap();
        let data: Vec<_> = recording.messages().map(|message| message.unwrap().data[..8].to_vec()).collect();
        std::fs::remove_dir_all(&directory).unwrap();
        assert_eq!(written.message_counts, [("/a".to_owned(), count)]);
        assert!(data.iter().zip(0..count).all(|(data, i)| *data == i.to_le_bytes()));
        assert_eq!(data.len() as u64, count);
    }

    #[test]
    fn a_failure_to_write_is_noticed_and_told() {
        let directory = std::env::temp_dir().join(format!("bag_replay_failure_{}", std::process::id()));
        let (mut storage, _warned) = start(&directory);
        storage.add_topic("/a", "std_msgs/msg/Bool", Vec::new());
        storage.add_topic("/a", "std_msgs/msg/Bool", Vec::new());
        let error = storage.finish().unwrap_err().to_string();
        std::fs::remove_dir_all(&directory).unwrap();
        assert!(error.contains("/a"), "{error}");
    }
}
