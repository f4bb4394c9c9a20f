//! Work on many things at once, so that a law is called once for all of them.
//!
//! # Why
//! A call of a function in an interpreter takes longer than what it does for one state. Solving a
//! motion or driving a run takes thousands of calls, one after the other. So works on several
//! things go on side by side on one thread, each on a stack of its own. A work stops where it asks
//! the law. When all have stopped, the law is called for the states of all.
//!
//! # Result
//! Each work gets what it would get alone, as far as the function gives the same numbers for a
//! state whatever states it is called with.

#![expect(deprecated, reason = "works ask from deep within, where there is no scope at hand")]

use super::{Batch, CustomLaw, Failure};
use generator::{Generator, Gn, is_generator, yield_};
use rayon::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Largest number of works side by side on a thread.
const MAX_TOGETHER: usize = 64;

/// Stack of a work, in machine words: 1 MB, of which a system takes what is used.
const STACK_WORDS: usize = 1 << 17;

/// Largest number of states of a call that several works share: its columns stay in fast memory.
const MAX_SHARED_STATES: usize = 4096;

/// What a law adds at the states of a work.
type Answer = Result<Vec<f64>, Failure>;

/// States of a work at which it asks a law.
struct Question {
    law: &'static CustomLaw,
    values: Vec<f64>,
    states: usize,
    /// All columns, one behind the other.
    columns: Vec<f64>,
}

/// Does work for each of several things, in parallel; results in their order.
///
/// With `is_shared`, works that ask a law of a user share its calls.
pub fn together<I: Sync, T: Send>(
    things: &[I],
    is_shared: bool,
    work: impl Fn(&I) -> T + Sync + Send,
) -> Vec<T> {
    if !is_shared {
        return things.par_iter().map(&work).collect();
    }
    if is_generator() {
        return things.iter().map(&work).collect();
    }
    // the interpreter does one call at a time: groups are no smaller than what shares a call
    let size = things.len().div_ceil(rayon::current_num_threads()).max(MAX_TOGETHER);
    things.par_chunks(size).flat_map_iter(|group| on_one_thread(group, &work)).collect()
}

/// What a law adds: by a call that works share where this is one of them.
pub(super) fn ask(law: &'static CustomLaw, at: &Batch, values: &[f64]) -> Answer {
    if !law.is_shared() || !is_generator() {
        return law.results(at, values);
    }
    let (values, columns) = (values.to_vec(), at.columns().to_vec());
    let question = Question { law, values, states: at.len(), columns };
    yield_::<Answer, Option<Question>>(Some(question)).expect("every question is answered")
}

/// Does works side by side.
fn on_one_thread<I: Sync, T: Send>(things: &[I], work: &(impl Fn(&I) -> T + Sync)) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let done: Vec<Mutex<Option<thread::Result<T>>>> =
        things.iter().map(|_| Mutex::default()).collect();
    let worker = || {
        // of all workers, which are on one thread, one runs at a time
        while let Some(place) = Some(next.fetch_add(1, Relaxed)).filter(|at| *at < things.len()) {
            let result = catch_unwind(AssertUnwindSafe(|| work(&things[place])));
            *done[place].lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
        }
        None
    };
    let count = things.len().min(MAX_TOGETHER);
    let worker = |_| Gn::<Answer>::new_opt(STACK_WORDS, worker);
    let mut workers: Vec<Generator<'_, Answer, Option<Question>>> =
        (0..count).map(worker).collect();
    let mut asked: Vec<(usize, Question)> = Vec::with_capacity(workers.len());
    for (place, worker) in workers.iter_mut().enumerate() {
        asked.extend(worker.resume().flatten().map(|question| (place, question)));
    }
    while !asked.is_empty() {
        let answered = catch_unwind(AssertUnwindSafe(|| answers(&asked)));
        let answers = answered.unwrap_or_else(|panic| {
            // workers that are dropped now begin nothing else
            next.store(things.len(), Relaxed);
            resume_unwind(panic)
        });
        let before = std::mem::take(&mut asked);
        for ((place, _), answer) in before.into_iter().zip(answers) {
            asked.extend(workers[place].send(answer).map(|question| (place, question)));
        }
    }
    drop(workers);
    let result = |one: Mutex<Option<thread::Result<T>>>| {
        let one = one.into_inner().unwrap_or_else(PoisonError::into_inner);
        one.expect("every work ends").unwrap_or_else(|panic| resume_unwind(panic))
    };
    done.into_iter().map(result).collect()
}

/// Answers to questions, in their order.
fn answers(asked: &[(usize, Question)]) -> Vec<Answer> {
    let mut answers: Vec<Option<Answer>> = asked.iter().map(|_| None).collect();
    for first in 0..asked.len() {
        if answers[first].is_some() {
            continue;
        }
        let of = &asked[first].1;
        let (mut shared, mut states) = (Vec::new(), 0);
        for (place, (_, other)) in asked.iter().enumerate().skip(first) {
            let is_same = std::ptr::eq(of.law, other.law) && of.values == other.values;
            let fits = shared.is_empty() || states + other.states <= MAX_SHARED_STATES;
            if answers[place].is_none() && is_same && fits {
                states += other.states;
                shared.push(place);
            }
        }
        let questions: Vec<&Question> = shared.iter().map(|place| &asked[*place].1).collect();
        for (place, answer) in shared.into_iter().zip(answers_of_one_call(&questions, states)) {
            answers[place] = Some(answer);
        }
    }
    answers.into_iter().flatten().collect()
}

/// Answers to questions to one law with the same values, by one call for all states together.
fn answers_of_one_call(questions: &[&Question], states: usize) -> Vec<Answer> {
    let law = questions[0].law;
    let alone =
        |of: &&Question| law.results(&Batch::new(law.kind(), of.states, &of.columns), &of.values);
    if questions.len() == 1 {
        return questions.iter().map(alone).collect();
    }
    let mut columns = Vec::with_capacity(states * law.kind().arguments().len());
    for argument in 0..law.kind().arguments().len() {
        for of in questions {
            columns.extend_from_slice(&of.columns[argument * of.states..][..of.states]);
        }
    }
    let at = Batch::new(law.kind(), states, &columns);
    // where it fails, each work learns whether it fails at its own states
    let Ok(found) = law.results(&at, &questions[0].values) else {
        return questions.iter().map(alone).collect();
    };
    let mut start = 0;
    let part = |of: &&Question| {
        let columns = found.chunks_exact(states);
        let part = columns.flat_map(|column| column[start..start + of.states].iter().copied());
        let part = part.collect();
        start += of.states;
        Ok(part)
    };
    questions.iter().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Argument, Declared, Kind, guarded};
    use super::*;
    use std::sync::Arc;

    /// A law that adds its only value times the speed and keeps the sizes of its calls.
    fn counted(sizes: &Arc<Mutex<Vec<usize>>>) -> &'static CustomLaw {
        let sizes = Arc::clone(sizes);
        let strength = Declared::size("strength", "N", 2.0);
        let law =
            CustomLaw::new(Kind::Force, "counted", "", &[strength], move |at, values, adds| {
                let speeds = at.column(Argument::ForwardSpeed);
                sizes.lock().expect("nobody panics").push(speeds.len());
                if speeds.contains(&7.0) {
                    return Err("seven".into());
                }
                for (force, speed) in adds.column(0).iter_mut().zip(speeds) {
                    *force = values[0] * speed;
                }
                Ok(())
            });
        Box::leak(Box::new(law.expect("a law that can be").shared()))
    }

    fn at(law: &'static CustomLaw, speed: f64, value: f64) -> Answer {
        let mut columns = vec![0.0; Kind::Force.arguments().len()];
        columns[0] = speed;
        ask(law, &Batch::new(Kind::Force, 1, &columns), &[value])
    }

    #[test]
    fn works_share_calls_and_get_what_they_would_get_alone() {
        let sizes = Arc::default();
        let law = counted(&sizes);
        let things: Vec<i32> = (0..150).collect();
        // works of several lengths, which ask with one of two values
        let work = |thing: &i32| -> f64 {
            let value = if *thing < 40 { 2.0 } else { 3.0 };
            let speed = |k: i32| 0.5 + f64::from(thing + k);
            (0..=thing % 4).map(|k| at(law, speed(k), value).expect("no seven")[0]).sum()
        };
        let shared = together(&things, true, work);
        let calls = sizes.lock().expect("nobody panics").len();
        assert_eq!(shared, together(&things, false, work));
        let alone = sizes.lock().expect("nobody panics").len() - calls;
        assert!(calls * 10 < alone, "{calls} of {alone}");
    }

    #[test]
    fn a_work_that_fails_fails_alone() {
        let law = counted(&Arc::default());
        let things: Vec<f64> = (0..20).map(f64::from).collect();
        let found = together(&things, true, |thing| at(law, *thing, 2.0).map(|row| row[0]));
        for (thing, one) in things.iter().zip(found) {
            assert_eq!(one.ok(), (*thing != 7.0).then_some(2.0 * thing));
        }
        let unwound = guarded(|| {
            together(&things, true, |thing| {
                at(law, *thing, 2.0).unwrap_or_else(|failure| failure.unwind())[0]
            })
        });
        assert!(unwound.expect_err("seven").to_string().contains("seven"));
    }

    #[test]
    fn works_within_works_share_calls() {
        let sizes = Arc::default();
        let law = counted(&sizes);
        let started = AtomicUsize::new(0);
        let things = [1.0, 2.0, 3.0];
        let found = together(&things, true, |thing| {
            started.fetch_add(1, Relaxed);
            together(&[10.0, 20.0], true, |inner| at(law, thing * inner, 2.0).expect("no seven")[0])
        });
        assert_eq!(found, [[20.0, 40.0], [40.0, 80.0], [60.0, 120.0]]);
        assert_eq!(*sizes.lock().expect("nobody panics"), [3, 3]);
        assert_eq!(started.load(Relaxed), 3);
    }
}
