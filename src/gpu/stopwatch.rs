//! Time of each pass, by timestamps of the device, or by the processor's clock where it has none.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::readback::read_buffer;
use super::{Gpu, GpuError};

/// Marks that one recording holds; passes beyond them are not timed.
const MAX_MARKS: u32 = 4096;
const NEEDED: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

/// What passes have taken, in the order in which they first came; several of one name are added up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Laps {
    /// Names and milliseconds.
    pub passes: Vec<(&'static str, f32)>,
    /// Measured by the device; else it cannot, and `passes` has but the time round the submission.
    pub is_of_device: bool,
}

/// Times the passes of one picture after the other.
pub struct Stopwatch {
    /// Timestamps and where they are read; none where the device has none.
    device: Option<(wgpu::QuerySet, wgpu::Buffer)>,
    record: Mutex<Record>,
}

/// What is known of a picture before it is drawn.
#[derive(Default)]
struct Record {
    /// What lies before each timestamp but the first.
    names: Vec<&'static str>,
    /// Work of the processor within the picture.
    work: Vec<(&'static str, Duration)>,
    begun: Option<Instant>,
}

impl Laps {
    fn add(&mut self, name: &'static str, milliseconds: f32) {
        match self.passes.iter_mut().find(|(known, _)| *known == name) {
            Some((_, sum)) => *sum += milliseconds,
            None => self.passes.push((name, milliseconds)),
        }
    }
}

impl Stopwatch {
    /// A watch for pictures that `gpu` draws.
    #[must_use]
    pub fn new(gpu: &Gpu) -> Self {
        let marks = || {
            let queries = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("passes"),
                ty: wgpu::QueryType::Timestamp,
                count: MAX_MARKS,
            });
            let ticks = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("ticks"),
                size: u64::from(MAX_MARKS) * 8,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            });
            (queries, ticks)
        };
        Self { device: gpu.device.features().contains(NEEDED).then(marks), record: Mutex::default() }
    }

    /// A picture begins.
    pub fn begin(&self, encoder: &mut wgpu::CommandEncoder) {
        *self.record() = Record { begun: Some(Instant::now()), ..Record::default() };
        if let Some((queries, _)) = &self.device {
            encoder.write_timestamp(queries, 0);
        }
    }

    /// What was recorded since the last mark is called `name`.
    pub fn lap(&self, encoder: &mut wgpu::CommandEncoder, name: &'static str) {
        let Some((queries, _)) = &self.device else { return };
        let names = &mut self.record().names;
        if names.len() + 1 < MAX_MARKS as usize {
            names.push(name);
            encoder.write_timestamp(queries, names.len() as u32);
        }
    }

    /// The processor has worked for a pass.
    pub fn work(&self, name: &'static str, time: Duration) {
        self.record().work.push((name, time));
    }

    /// The picture ends.
    pub fn end(&self, encoder: &mut wgpu::CommandEncoder) {
        if let Some((queries, ticks)) = &self.device {
            encoder.resolve_query_set(queries, 0..self.record().names.len() as u32 + 1, ticks, 0);
        }
    }

    /// Reads the watch after the picture was submitted; waits until it is drawn.
    ///
    /// # Errors
    /// The device was lost.
    pub fn read(&self, gpu: &Gpu) -> Result<Laps, GpuError> {
        let record = self.record();
        let mut laps = Laps { passes: Vec::new(), is_of_device: self.device.is_some() };
        for &(name, time) in &record.work {
            laps.add(name, 1e3 * time.as_secs_f32());
        }
        if let Some((_, ticks)) = &self.device {
            let bytes = read_buffer(gpu, ticks)?;
            let ticks: Vec<u64> = bytes.as_chunks().0.iter().map(|tick| u64::from_le_bytes(*tick)).collect();
            let period = gpu.queue.get_timestamp_period() * 1e-6;
            for (&name, between) in record.names.iter().zip(ticks.windows(2)) {
                laps.add(name, between[1].saturating_sub(between[0]) as f32 * period);
            }
        } else if let Some(begun) = record.begun {
            gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| GpuError::Lost(error.to_string()))?;
            laps.add("all passes", 1e3 * begun.elapsed().as_secs_f32());
        }
        Ok(laps)
    }

    /// Whole at any time: nothing panics while it is held.
    fn record(&self) -> MutexGuard<'_, Record> {
        self.record.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
