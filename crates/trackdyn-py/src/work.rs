//! Work that takes long: on threads of its own, so that Python goes on, Ctrl-C is heard at once and
//! progress is told by the thread that called.

use crate::errors::raised;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use trackdyn::{Error, Observer, Progress};

/// Time between two looks at signals and progress.
const POLL_INTERVAL: Duration = Duration::from_millis(50);

/// Stack of a thread, bytes: that of a main thread.
const STACK_SIZE: usize = 8 << 20;

/// The threads that share the work, and the process that they are of.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads of this process. Those of a parent are not there in a process that was forked.
fn pool() -> Arc<ThreadPool> {
    let process = std::process::id();
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    match &*pool {
        Some((of, threads)) if *of == process => threads.clone(),
        _ => {
            let threads = ThreadPoolBuilder::new()
                .stack_size(STACK_SIZE)
                .build()
                .expect("threads can be started");
            let threads = Arc::new(threads);
            // the drop of a pool waits for no thread, so that of a parent can go
            *pool = Some((process, threads.clone()));
            threads
        }
    }
}

/// What worker and caller share.
#[derive(Default)]
struct Shared {
    is_stopped: AtomicBool,
    latest: Mutex<Option<Progress>>,
}

/// Does a job without holding the interpreter. `progress` is called with stage, finished parts and
/// all parts, by the thread that called, at most twenty times a second.
///
/// # Errors
/// Those of the job; KeyboardInterrupt, and what `progress` raises: the job then ends by itself at
/// its next part, and nobody waits for it.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    job: impl FnOnce(&Observer) -> Result<T, Error> + Send + 'static,
) -> PyResult<T> {
    let shared = Arc::new(Shared::default());
    let (sender, mut receiver) = channel();
    let of_worker = shared.clone();
    let work = move || {
        let observer = |at: Progress| {
            *of_worker.latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(at);
            if of_worker.is_stopped.load(Ordering::Relaxed) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        // a panic is that of the caller
        let result = catch_unwind(AssertUnwindSafe(|| job(&observer)));
        // nobody waits after an interrupt
        let _ = sender.send(result);
    };
    pool().spawn(work);
    let mut told = None;
    loop {
        let (back, got) = py.detach(move || {
            let got = receiver.recv_timeout(POLL_INTERVAL);
            (receiver, got)
        });
        receiver = back;
        match got {
            Ok(Err(panic)) => resume_unwind(panic),
            Ok(Ok(result)) => {
                let result = result.map_err(raised)?;
                tell(progress, &shared, &mut told)?;
                return Ok(result);
            }
            Err(RecvTimeoutError::Timeout) => {
                let heard = py.check_signals().and_then(|()| tell(progress, &shared, &mut told));
                if heard.is_err() {
                    shared.is_stopped.store(true, Ordering::Relaxed);
                }
                heard?;
            }
            Err(RecvTimeoutError::Disconnected) => return Err(raised(Error::Cancelled)),
        }
    }
}

/// Tells how far the work is, where that has changed.
fn tell(
    progress: Option<&Bound<'_, PyAny>>,
    shared: &Shared,
    told: &mut Option<Progress>,
) -> PyResult<()> {
    let Some(progress) = progress else { return Ok(()) };
    let latest = *shared.latest.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(at) = latest.filter(|at| Some(*at) != *told) {
        *told = Some(at);
        progress.call1((at.stage, at.done, at.total))?;
    }
    Ok(())
}
