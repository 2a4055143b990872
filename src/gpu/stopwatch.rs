//! Measures the time of each pass: by timestamps of the device, or by the processor's clock if the device has none.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::readback::read_buffer;
use super::{Gpu, GpuError};

/// Largest number of timestamps of one picture; passes beyond them are not timed.
const MAX_MARKS: u32 = 4096;
/// Device features that timestamps between passes require.
const NEEDED: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

/// Durations of passes, in the order in which each name first occurs. The times of passes of the same name are added
/// up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Laps {
    /// Names and milliseconds.
    pub passes: Vec<(&'static str, f32)>,
    /// True if the device measured the passes. False if it cannot: then `passes` has one entry for all of them,
    /// measured by the processor's clock.
    pub is_of_device: bool,
}

/// Measures the passes of pictures, one picture at a time.
pub struct Stopwatch {
    /// Timestamps, and the buffer from which they are read; `None` if the device has no timestamps.
    device: Option<(wgpu::QuerySet, wgpu::Buffer)>,
    record: Mutex<Record>,
}

/// Record of a picture before the device has drawn it.
#[derive(Default)]
struct Record {
    /// Name of the pass that ends at each timestamp except the first.
    names: Vec<&'static str>,
    /// Passes and time that the processor worked for them.
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
    /// Returns a stopwatch for pictures that `gpu` draws.
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

    /// Begins a picture.
    pub fn begin(&self, encoder: &mut wgpu::CommandEncoder) {
        *self.record() = Record { begun: Some(Instant::now()), ..Record::default() };
        if let Some((queries, _)) = &self.device {
            encoder.write_timestamp(queries, 0);
        }
    }

    /// Ends a lap: the commands recorded since the last call are the pass `name`.
    pub fn lap(&self, encoder: &mut wgpu::CommandEncoder, name: &'static str) {
        let Some((queries, _)) = &self.device else { return };
        let names = &mut self.record().names;
        if names.len() + 1 < MAX_MARKS as usize {
            names.push(name);
            encoder.write_timestamp(queries, names.len() as u32);
        }
    }

    /// Records time that the processor worked for a pass.
    pub fn work(&self, name: &'static str, time: Duration) {
        self.record().work.push((name, time));
    }

    /// Ends the picture.
    pub fn end(&self, encoder: &mut wgpu::CommandEncoder) {
        if let Some((queries, ticks)) = &self.device {
            encoder.resolve_query_set(queries, 0..self.record().names.len() as u32 + 1, ticks, 0);
        }
    }

    /// Reads the times after the picture was submitted. Blocks until it is drawn.
    ///
    /// # Errors
    /// Returns an error if the device was lost.
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
            gpu.wait()?;
            laps.add("all passes", 1e3 * begun.elapsed().as_secs_f32());
        }
        Ok(laps)
    }

    /// Returns the locked record. Its lock can be used after a panic, because no panic leaves the record half changed.
    fn record(&self) -> MutexGuard<'_, Record> {
        self.record.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
