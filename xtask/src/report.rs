//! What a demo measured, beside what it should measure: the content of `report.json`.

use std::fmt;

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};
use serde_json::{Value, json};

/// What a number in a report should satisfy. An array satisfies a target if every element does.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// Nothing is asked: the number informs.
    Free,
    /// Not above this.
    AtMost(f64),
    /// Not below this.
    AtLeast(f64),
    /// Each element of `values` met to `tolerance` (absolute), the lengths equal.
    Near {
        /// The expected number, or numbers in order.
        values: Vec<f64>,
        /// Largest absolute difference allowed.
        tolerance: f64,
    },
    /// Equal to this, numbers compared as `f64`.
    Exactly(Value),
}

impl Target {
    /// Within `tolerance` (absolute) of `value`.
    #[must_use]
    pub fn within(value: f64, tolerance: f64) -> Self {
        Self::Near {
            values: vec![value],
            tolerance,
        }
    }

    /// An array of numbers, each within `tolerance` (absolute) of the one in `values`.
    #[must_use]
    pub fn near(values: &[f64], tolerance: f64) -> Self {
        Self::Near {
            values: values.to_vec(),
            tolerance,
        }
    }

    /// Equal to `value`: a count, a text, an array of them.
    #[must_use]
    pub fn exactly(value: impl Into<Value>) -> Self {
        Self::Exactly(value.into())
    }

    /// Whether `value` satisfies this. NaN and infinities (`null` in JSON) satisfy only [`Target::Free`].
    #[must_use]
    pub fn is_met(&self, value: &Value) -> bool {
        match self {
            Self::Free => true,
            Self::AtMost(limit) => every(value, &|x| x <= *limit),
            Self::AtLeast(limit) => every(value, &|x| x >= *limit),
            Self::Near { values, tolerance } => match value {
                Value::Array(items) => {
                    items.len() == values.len()
                        && items.iter().zip(values).all(|(item, &expected)| {
                            every(item, &|x| (x - expected).abs() <= *tolerance)
                        })
                }
                scalar => match values.as_slice() {
                    [expected] => every(scalar, &|x| (x - expected).abs() <= *tolerance),
                    _ => false,
                },
            },
            Self::Exactly(expected) => same(value, expected),
        }
    }

    fn json(&self, met: bool) -> Value {
        match self {
            Self::Free => Value::Null,
            Self::AtMost(limit) => json!({"relation": "at most", "value": limit, "met": met}),
            Self::AtLeast(limit) => json!({"relation": "at least", "value": limit, "met": met}),
            Self::Near { values, tolerance } => {
                json!({"relation": "near", "value": values, "tolerance": tolerance, "met": met})
            }
            Self::Exactly(value) => json!({"relation": "exactly", "value": value, "met": met}),
        }
    }
}

fn every(value: &Value, condition: &dyn Fn(f64) -> bool) -> bool {
    match value {
        Value::Array(items) => !items.is_empty() && items.iter().all(|item| every(item, condition)),
        other => other.as_f64().is_some_and(condition),
    }
}

fn same(value: &Value, expected: &Value) -> bool {
    match (value, expected) {
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(x, y)| same(x, y))
        }
        (Value::Number(a), Value::Number(b)) => a.as_f64() == b.as_f64(),
        _ => value == expected,
    }
}

/// The target in words, as the gallery shows it: `≤ 1e-9`.
impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Free => Ok(()),
            Self::AtMost(limit) => write!(f, "≤ {}", plain(&json!(limit))),
            Self::AtLeast(limit) => write!(f, "≥ {}", plain(&json!(limit))),
            Self::Near { values, tolerance } => {
                let value = match values.as_slice() {
                    [one] => json!(one),
                    many => json!(many),
                };
                write!(f, "{} ± {}", plain(&value), plain(&json!(tolerance)))
            }
            Self::Exactly(value) => write!(f, "= {}", plain(value)),
        }
    }
}

/// A JSON value for people: six significant digits, an exponent where it helps, arrays in brackets.
#[must_use]
pub fn plain(value: &Value) -> String {
    match value {
        Value::Number(number) => match (number.as_i64(), number.as_f64()) {
            (Some(integer), _) => integer.to_string(),
            (None, Some(x)) => plain_float(x),
            (None, None) => number.to_string(),
        },
        Value::String(text) => text.clone(),
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(plain).collect();
            format!("[{}]", items.join(", "))
        }
        Value::Null => "not finite".into(),
        other => other.to_string(),
    }
}

fn plain_float(x: f64) -> String {
    if x == 0.0 {
        "0".into()
    } else if (1e-3..1e6).contains(&x.abs()) {
        let digits = 5 - x.abs().log10().floor() as i32;
        let text = format!("{x:.*}", digits.clamp(0, 9) as usize);
        if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').into()
        } else {
            text
        }
    } else {
        let text = format!("{x:.2e}");
        text.replace(".00e", "e").replace("0e", "e")
    }
}

/// One measured number with its target.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The key that the number has in `report.json`.
    pub key: String,
    /// What was measured: a number, a text or an array.
    pub value: Value,
    /// What it should satisfy.
    pub target: Target,
}

impl Measured {
    /// Whether the number satisfies its target.
    #[must_use]
    pub fn is_met(&self) -> bool {
        self.target.is_met(&self.value)
    }
}

/// A picture that the gallery shows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Picture {
    /// File name in the demo's folder.
    pub file: String,
    /// What it shows, under the picture.
    pub caption: String,
    /// What one sees, for who cannot see it.
    pub alt: String,
}

/// What one run of a demo wrote and measured.
#[derive(Clone, Debug)]
pub struct Report {
    /// Name of the demo.
    pub demo: String,
    /// Paper and figures that it answers.
    pub paper: String,
    /// Wall time of the run.
    pub seconds: f64,
    /// Every file written, in order, without `report.json`.
    pub files: Vec<String>,
    /// The pictures among the files.
    pub pictures: Vec<Picture>,
    /// The measured numbers, in order.
    pub numbers: Vec<Measured>,
}

impl Report {
    /// The numbers that miss their targets.
    pub fn missed(&self) -> impl Iterator<Item = &Measured> {
        self.numbers.iter().filter(|number| !number.is_met())
    }
}

impl Serialize for Report {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        struct Ordered<'a>(Vec<(&'a str, Value)>);
        impl Serialize for Ordered<'_> {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_map(self.0.iter().map(|(key, value)| (key, value)))
            }
        }
        let numbers = self
            .numbers
            .iter()
            .map(|n| (n.key.as_str(), n.value.clone()));
        let targets = self
            .numbers
            .iter()
            .filter(|n| n.target != Target::Free)
            .map(|n| (n.key.as_str(), n.target.json(n.is_met())));
        let mut map = serializer.serialize_map(Some(7))?;
        map.serialize_entry("demo", &self.demo)?;
        map.serialize_entry("paper", &self.paper)?;
        map.serialize_entry("seconds", &self.seconds)?;
        map.serialize_entry("files", &self.files)?;
        map.serialize_entry("numbers", &Ordered(numbers.collect()))?;
        map.serialize_entry("targets", &Ordered(targets.collect()))?;
        map.serialize_entry("pictures", &self.pictures)?;
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_hold_and_fail() {
        assert!(Target::AtMost(1e-9).is_met(&json!(1e-10)));
        assert!(!Target::AtMost(1e-9).is_met(&json!(1e-8)));
        assert!(!Target::AtMost(1e-9).is_met(&json!(f64::NAN)));
        assert!(!Target::AtMost(1e-9).is_met(&json!([1e-10, f64::INFINITY])));
        assert!(Target::AtLeast(2.0).is_met(&json!([2, 3])));
        assert!(Target::within(2.0, 0.2).is_met(&json!(1.9)));
        assert!(!Target::within(2.0, 0.2).is_met(&json!([1.9, 2.0])));
        assert!(Target::near(&[1.0, 2.0], 0.1).is_met(&json!([1.05, 2])));
        assert!(Target::exactly(json!([2, 1, 0])).is_met(&json!([2.0, 1.0, 0.0])));
        assert!(!Target::exactly(0).is_met(&json!(1)));
        assert!(!Target::AtMost(1.0).is_met(&json!([])));
    }

    #[test]
    fn numbers_read_well() {
        assert_eq!(plain(&json!(3.10e-13)), "3.1e-13");
        assert_eq!(plain(&json!(1e-9)), "1e-9");
        assert_eq!(plain(&json!(2.0)), "2");
        assert_eq!(plain(&json!(100_000.0)), "100000");
        assert_eq!(plain(&json!(1.0 / 3.0)), "0.333333");
        assert_eq!(plain(&json!([1, 2.5])), "[1, 2.5]");
        assert_eq!(Target::within(2.0, 0.2).to_string(), "2 ± 0.2");
    }
}
