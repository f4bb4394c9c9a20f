//! What a function of Python does with its columns, as steps that need no interpreter.

use pyo3::prelude::*;
use trackdyn::law::{Batch, Results};

/// Rows that are worked on at once: what all steps leave stays in the fast memory.
const ROWS: usize = 256;

/// A step: the name of a function of numpy and the places of what it takes, or a number.
#[derive(FromPyObject)]
pub enum Step {
    /// A number.
    #[pyo3(transparent)]
    Number(f64),
    /// A function and the places of its arguments: columns, parameters, then steps.
    Call(String, Vec<usize>),
    /// Polynomials between ascending places, and the place of the argument. Coefficients of the
    /// distance from the place below: a row for each power, the highest first.
    Table(Vec<f64>, Vec<Vec<f64>>, usize),
}

#[derive(Debug)]
enum Operation {
    Number(f64),
    Table(Table, usize),
    Unary(fn(f64) -> f64, usize),
    Binary(Binary, [usize; 2]),
    Where([usize; 3]),
}

/// A function of two numbers; the common ones by name, so that their loops are fast.
#[derive(Clone, Copy, Debug)]
enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Other(fn(f64, f64) -> f64),
}

/// A value at a step: one number, or one for each row.
#[derive(Clone, Copy)]
enum Value<'a> {
    One(f64),
    Rows(&'a [f64]),
}

/// Polynomials between ascending places.
#[derive(Debug)]
struct Table {
    places: Vec<f64>,
    coefficients: Vec<Vec<f64>>,
}

impl Table {
    fn new(places: &[f64], coefficients: &[Vec<f64>]) -> Option<Self> {
        let is_table = places.len() >= 2
            && places.windows(2).all(|pair| pair[0] < pair[1])
            && coefficients.iter().all(|row| row.len() + 1 == places.len());
        is_table.then(|| Self { places: places.to_vec(), coefficients: coefficients.to_vec() })
    }

    /// Its value; beyond its ends, the first and the last polynomial go on.
    fn at(&self, x: f64) -> f64 {
        let below = self.places.partition_point(|place| *place <= x);
        let piece = below.saturating_sub(1).min(self.places.len() - 2);
        let distance = x - self.places[piece];
        self.coefficients.iter().fold(0.0, |sum, row| sum * distance + row[piece])
    }
}

/// A list of steps.
#[derive(Debug)]
pub struct Tape {
    /// Number of columns and of parameters.
    arguments: usize,
    parameters: usize,
    operations: Vec<Operation>,
    /// Places of the results.
    results: Vec<usize>,
}

fn refused(what: impl std::fmt::Display) -> PyErr {
    pyo3::exceptions::PyNotImplementedError::new_err(format!("{what} is no step of a tape"))
}

impl Tape {
    /// The tape of steps for so many columns, parameters and results.
    pub fn new(
        [arguments, parameters, count]: [usize; 3],
        steps: &[Step],
        results: Vec<usize>,
    ) -> PyResult<Self> {
        let before = arguments + parameters;
        let operation = |(place, step): (usize, &Step)| {
            let (name, of) = match step {
                Step::Number(value) => return Ok(Operation::Number(*value)),
                Step::Call(name, of) => (name.as_str(), of),
                Step::Table(places, coefficients, of) => {
                    let table = Table::new(places, coefficients).filter(|_| *of < before + place);
                    let table = table.map(|table| Operation::Table(table, *of));
                    return table.ok_or_else(|| refused("a table"));
                }
            };
            if of.iter().any(|one| *one >= before + place) {
                return Err(refused(name));
            }
            let found = match of[..] {
                [a] => unary(name).map(|function| Operation::Unary(function, a)),
                [a, b] => binary(name).map(|function| Operation::Binary(function, [a, b])),
                [a, b, c] if name == "where" => Some(Operation::Where([a, b, c])),
                _ => None,
            };
            found.ok_or_else(|| refused(name))
        };
        let operations: Vec<_> =
            steps.iter().enumerate().map(operation).collect::<PyResult<_>>()?;
        if results.len() != count || results.iter().any(|one| *one >= before + steps.len()) {
            return Err(refused("a result"));
        }
        Ok(Self { arguments, parameters, operations, results })
    }

    /// Places of the columns that it reads.
    pub fn reads(&self) -> Vec<usize> {
        let mut read = vec![false; self.arguments + self.parameters + self.operations.len()];
        let mut mark = |place: usize| read[place] = true;
        self.results.iter().copied().for_each(&mut mark);
        for operation in &self.operations {
            match *operation {
                Operation::Number(_) => {}
                Operation::Unary(_, a) | Operation::Table(_, a) => mark(a),
                Operation::Binary(_, of) => of.into_iter().for_each(&mut mark),
                Operation::Where(of) => of.into_iter().for_each(&mut mark),
            }
        }
        (0..self.arguments).filter(|place| read[*place]).collect()
    }

    /// What it adds at a batch of states.
    pub fn evaluate(&self, at: &Batch, values: &[f64], adds: &mut Results) {
        self.evaluate_columns(at.columns(), at.len(), values, adds.columns());
    }

    /// What it adds at columns of so many rows.
    pub fn evaluate_columns(&self, columns: &[f64], rows: usize, values: &[f64], adds: &mut [f64]) {
        let chunk = ROWS.min(rows);
        let mut slab = vec![0.0; self.operations.len() * chunk];
        let mut ones = vec![None; self.operations.len()];
        let mut start = 0;
        while start < rows {
            let count = chunk.min(rows - start);
            for (place, operation) in self.operations.iter().enumerate() {
                let (done, rest) = slab.split_at_mut(place * chunk);
                let value = |of: usize| -> Value {
                    if of < self.arguments {
                        return Value::Rows(&columns[of * rows + start..][..count]);
                    }
                    let of = of - self.arguments;
                    if of < self.parameters {
                        return Value::One(values[of]);
                    }
                    let of = of - self.parameters;
                    let row = Value::Rows(&done[of * chunk..][..count]);
                    ones[of].map_or(row, Value::One)
                };
                ones[place] = operation.apply(value, &mut rest[..count]);
            }
            for (adds, &result) in adds.chunks_exact_mut(rows).zip(&self.results) {
                let adds = &mut adds[start..start + count];
                let step = result.checked_sub(self.arguments + self.parameters);
                match (step, result.checked_sub(self.arguments)) {
                    (Some(step), _) => match ones[step] {
                        Some(one) => adds.fill(one),
                        None => adds.copy_from_slice(&slab[step * chunk..][..count]),
                    },
                    (None, Some(parameter)) => adds.fill(values[parameter]),
                    (None, None) => {
                        adds.copy_from_slice(&columns[result * rows + start..][..count]);
                    }
                }
            }
            start += count;
        }
    }
}

impl Operation {
    /// Its value: one number, or none where it has filled the rows.
    fn apply<'a>(&self, value: impl Fn(usize) -> Value<'a>, rows: &mut [f64]) -> Option<f64> {
        match *self {
            Self::Number(one) => Some(one),
            Self::Unary(function, a) => each(function, value(a), rows),
            Self::Table(ref table, a) => each(|x| table.at(x), value(a), rows),
            Self::Binary(function, [a, b]) => {
                let (a, b) = (value(a), value(b));
                match function {
                    Binary::Add => both(|a, b| a + b, a, b, rows),
                    Binary::Subtract => both(|a, b| a - b, a, b, rows),
                    Binary::Multiply => both(|a, b| a * b, a, b, rows),
                    Binary::Divide => both(|a, b| a / b, a, b, rows),
                    Binary::Other(function) => both(function, a, b, rows),
                }
            }
            Self::Where([c, a, b]) => {
                let (c, a, b) = (value(c), value(a), value(b));
                if let (Value::One(c), Value::One(a), Value::One(b)) = (c, a, b) {
                    return Some(if c == 0.0 { b } else { a });
                }
                let at = |of: Value, row: usize| match of {
                    Value::One(one) => one,
                    Value::Rows(rows) => rows[row],
                };
                for (row, into) in rows.iter_mut().enumerate() {
                    *into = if at(c, row) == 0.0 { at(b, row) } else { at(a, row) };
                }
                None
            }
        }
    }
}

#[inline]
fn each(function: impl Fn(f64) -> f64, a: Value, rows: &mut [f64]) -> Option<f64> {
    match a {
        Value::One(a) => return Some(function(a)),
        Value::Rows(a) => rows.iter_mut().zip(a).for_each(|(row, a)| *row = function(*a)),
    }
    None
}

#[inline]
fn both(function: impl Fn(f64, f64) -> f64, a: Value, b: Value, rows: &mut [f64]) -> Option<f64> {
    match (a, b) {
        (Value::One(a), Value::One(b)) => return Some(function(a, b)),
        (Value::One(a), Value::Rows(b)) => {
            rows.iter_mut().zip(b).for_each(|(row, b)| *row = function(a, *b));
        }
        (Value::Rows(a), Value::One(b)) => {
            rows.iter_mut().zip(a).for_each(|(row, a)| *row = function(*a, b));
        }
        (Value::Rows(a), Value::Rows(b)) => {
            rows.iter_mut().zip(a.iter().zip(b)).for_each(|(row, (a, b))| *row = function(*a, *b));
        }
    }
    None
}

/// One for true, zero for false, as numpy counts them.
fn truth(is: bool) -> f64 {
    f64::from(u8::from(is))
}

/// A function of numpy of one argument.
fn unary(name: &str) -> Option<fn(f64) -> f64> {
    let function: fn(f64) -> f64 = match name {
        "negative" => |a| -a,
        "positive" => |a| a,
        "absolute" | "fabs" => f64::abs,
        "sign" => |a| {
            if a > 0.0 {
                1.0
            } else if a < 0.0 {
                -1.0
            } else {
                a
            }
        },
        "square" => |a| a * a,
        "sqrt" => f64::sqrt,
        "cbrt" => f64::cbrt,
        "reciprocal" => f64::recip,
        "exp" => f64::exp,
        "exp2" => f64::exp2,
        "expm1" => f64::exp_m1,
        "log" => f64::ln,
        "log2" => f64::log2,
        "log10" => f64::log10,
        "log1p" => f64::ln_1p,
        "sin" => f64::sin,
        "cos" => f64::cos,
        "tan" => f64::tan,
        "arcsin" => f64::asin,
        "arccos" => f64::acos,
        "arctan" => f64::atan,
        "sinh" => f64::sinh,
        "cosh" => f64::cosh,
        "tanh" => f64::tanh,
        "arcsinh" => f64::asinh,
        "arccosh" => f64::acosh,
        "arctanh" => f64::atanh,
        "deg2rad" | "radians" => f64::to_radians,
        "rad2deg" | "degrees" => f64::to_degrees,
        "floor" => f64::floor,
        "ceil" => f64::ceil,
        "trunc" => f64::trunc,
        "rint" => f64::round_ties_even,
        "logical_not" => |a| truth(a == 0.0),
        "isfinite" => |a| truth(a.is_finite()),
        "isnan" => |a| truth(a.is_nan()),
        "isinf" => |a| truth(a.is_infinite()),
        "signbit" => |a| truth(a.is_sign_negative()),
        "erf" => libm::erf,
        "erfc" => libm::erfc,
        "gamma" => libm::tgamma,
        "gammaln" => libm::lgamma,
        "j0" => libm::j0,
        "j1" => libm::j1,
        "expit" => |a| 1.0 / (1.0 + (-a).exp()),
        "log_expit" => |a| a.min(0.0) - (-a.abs()).exp().ln_1p(),
        "logit" => |a| (a / (1.0 - a)).ln(),
        "exp10" => |a| 10.0_f64.powf(a),
        "ndtr" => |a| 0.5 * libm::erfc(-a * std::f64::consts::FRAC_1_SQRT_2),
        _ => return None,
    };
    Some(function)
}

/// A function of numpy of two arguments.
fn binary(name: &str) -> Option<Binary> {
    let function: fn(f64, f64) -> f64 = match name {
        "add" => return Some(Binary::Add),
        "subtract" => return Some(Binary::Subtract),
        "multiply" => return Some(Binary::Multiply),
        "divide" | "true_divide" => return Some(Binary::Divide),
        "power" | "float_power" => |a, b| if b == 2.0 { a * a } else { a.powf(b) },
        "arctan2" => f64::atan2,
        "hypot" => f64::hypot,
        "copysign" => f64::copysign,
        "maximum" => |a, b| if a > b || a.is_nan() { a } else { b },
        "minimum" => |a, b| if a < b || a.is_nan() { a } else { b },
        "fmax" => f64::max,
        "fmin" => f64::min,
        "remainder" | "mod" => |a, b| {
            let rest = a % b;
            if rest != 0.0 && (rest < 0.0) != (b < 0.0) { rest + b } else { rest }
        },
        "fmod" => |a, b| a % b,
        "floor_divide" => |a, b| {
            let rest = a % b;
            let whole = (a - rest) / b;
            let is_below = rest != 0.0 && (rest < 0.0) != (b < 0.0);
            if is_below { whole - 1.0 } else { whole }.round()
        },
        "xlogy" => |a, b| if a == 0.0 && !b.is_nan() { 0.0 } else { a * b.ln() },
        "xlog1py" => |a, b| if a == 0.0 && !b.is_nan() { 0.0 } else { a * b.ln_1p() },
        "logaddexp" => |a, b| {
            if a == b {
                a + std::f64::consts::LN_2
            } else {
                a.max(b) + (-(a - b).abs()).exp().ln_1p()
            }
        },
        "heaviside" => |a, b| {
            if a > 0.0 {
                1.0
            } else if a < 0.0 {
                0.0
            } else {
                b
            }
        },
        "greater" => |a, b| truth(a > b),
        "greater_equal" => |a, b| truth(a >= b),
        "less" => |a, b| truth(a < b),
        "less_equal" => |a, b| truth(a <= b),
        "equal" => |a, b| truth(a == b),
        "not_equal" => |a, b| truth(a != b),
        "logical_and" => |a, b| truth(a != 0.0 && b != 0.0),
        "logical_or" => |a, b| truth(a != 0.0 || b != 0.0),
        "logical_xor" => |a, b| truth((a != 0.0) != (b != 0.0)),
        _ => return None,
    };
    Some(Binary::Other(function))
}
