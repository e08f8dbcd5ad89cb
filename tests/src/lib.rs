//! The reader of the reference fixtures.
//!
//! A fixture file is read whole. [`judge`] hands every case to a function of the test, which computes the answer and
//! gives it to the [`Case`]; the case compares it with what the file expects. Nothing passes unseen: a kind that the
//! test does not know, an expected key that the test did not look at, a panic inside a case and a file without cases
//! all fail, with the name of the case.
//!
//! ```
//! use integration_tests::{Case, Tolerance, judge};
//! use serde_json::json;
//!
//! let file = json!({"cases": [
//!     {"kind": "sum", "name": "two and three", "input": {"a": 2, "b": 3}, "expected": {"sum": 5}},
//! ]});
//! let cases = file["cases"].as_array().unwrap().iter().map(|value| {
//!     Case::new(value["name"].as_str().unwrap(), value["kind"].as_str().unwrap(), &value["input"])
//!         .expecting(&value["expected"], Tolerance::Componentwise(1e-12))
//! });
//! judge("sums", cases, |case| match case.kind() {
//!     "sum" => case.compare("sum", case.number("a") + case.number("b")),
//!     _ => case.unknown_kind(),
//! });
//! ```

#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct ReadmeDoctests;

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use serde_json::Value;

mod compare;
pub use compare::Tolerance;

/// The folder of the reference files: `FIXTURES_DIR`, or `tests/fixtures` of this repository.
#[must_use]
pub fn fixtures_folder() -> PathBuf {
    match std::env::var_os("FIXTURES_DIR") {
        Some(folder) => PathBuf::from(folder),
        None => PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fixtures"),
    }
}

/// Reads the file `name` (without `.json`) of [`fixtures_folder`].
///
/// # Panics
///
/// With the path, if the file is missing or is not JSON: this is test code.
#[must_use]
#[expect(
    clippy::panic,
    reason = "a test that cannot read its reference must fail"
)]
pub fn read(name: &str) -> Value {
    let path = fixtures_folder().join(format!("{name}.json"));
    let text = std::fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The list at the top-level key `key` of a file; empty if the file lacks the key.
///
/// # Panics
///
/// If the key holds something else than a list, or if the file has cases at another top-level key, which then would pass
/// unseen: this is test code.
#[must_use]
#[expect(clippy::panic, reason = "a malformed file fails by name")]
pub fn list_at<'a>(file: &'a Value, key: &str) -> &'a [Value] {
    for (other, value) in file.as_object().into_iter().flatten() {
        let holds_cases = value
            .as_array()
            .is_some_and(|list| list.iter().any(Value::is_object));
        assert!(
            other == key || !holds_cases,
            "unknown list of cases {other}"
        );
    }
    match file.get(key) {
        None => &[],
        Some(Value::Array(list)) => list,
        Some(other) => panic!("{key} is no list: {other}"),
    }
}

/// The folder of real meshes, if `MESH_DIR` names one.
#[must_use]
pub fn mesh_folder() -> Option<PathBuf> {
    std::env::var_os("MESH_DIR").map(PathBuf::from)
}

/// Runs `answer` on every case and fails with all that went wrong, each with the name of its case.
///
/// # Panics
///
/// If a case failed, or if there was none.
#[expect(clippy::panic, reason = "this is how a test fails")]
pub fn judge<'a>(
    subject: &str,
    cases: impl IntoIterator<Item = Case<'a>>,
    answer: impl Fn(&Case<'a>),
) {
    let mut count = 0_usize;
    let mut failures = Vec::new();
    for case in cases {
        count += 1;
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| answer(&case))) {
            let words = panic
                .downcast_ref::<String>()
                .cloned()
                .or_else(|| panic.downcast_ref::<&str>().map(ToString::to_string))
                .unwrap_or_default();
            case.fail(format!("panicked: {words}"));
        } else {
            case.fail_unread();
        }
        let found = case.failures.into_inner();
        failures.extend(
            found
                .iter()
                .map(|failure| format!("{} [{}]: {failure}", case.name, case.kind)),
        );
    }
    assert!(count > 0, "{subject}: no case was read");
    if !failures.is_empty() {
        panic!(
            "{subject}: {} failures in {count} cases\n{}",
            failures.len(),
            failures.join("\n")
        );
    }
    println!("{subject}: {count} cases");
}

/// One case of a fixture file: its input, what is expected, and what has been compared so far.
#[derive(Debug)]
pub struct Case<'a> {
    name: String,
    kind: String,
    input: &'a Value,
    expected: &'a Value,
    error: Option<&'a str>,
    tolerance: Tolerance,
    read: RefCell<BTreeSet<String>>,
    failures: RefCell<Vec<String>>,
}

impl<'a> Case<'a> {
    /// A case with its name, its kind (what is to be computed) and its input.
    #[must_use]
    pub fn new(name: &str, kind: &str, input: &'a Value) -> Self {
        Self {
            name: name.to_owned(),
            kind: kind.to_owned(),
            input,
            expected: &Value::Null,
            error: None,
            tolerance: Tolerance::Componentwise(0.0),
            read: RefCell::default(),
            failures: RefCell::default(),
        }
    }

    /// Sets the expected values and the file's tolerance for them. An `error` key among them is the expected refusal.
    #[must_use]
    pub fn expecting(mut self, expected: &'a Value, tolerance: Tolerance) -> Self {
        self.expected = expected;
        self.tolerance = tolerance;
        if let Some(error) = expected.get("error").and_then(Value::as_str) {
            self.error = Some(error);
        }
        self
    }

    /// Sets the expected refusal, in the file's words.
    #[must_use]
    pub fn expecting_error(mut self, words: &'a str) -> Self {
        self.error = Some(words);
        self
    }

    /// The case's label.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What is to be computed.
    #[must_use]
    pub fn kind(&self) -> &str {
        &self.kind
    }

    /// The whole input.
    #[must_use]
    pub fn input(&self) -> &'a Value {
        self.input
    }

    /// The whole of what is expected, for judgements that are not a comparison of one key. Mark the keys with [`Case::seen`].
    #[must_use]
    pub fn expected(&self) -> &'a Value {
        self.expected
    }

    /// The tolerance of the file for this case.
    #[must_use]
    pub fn tolerance(&self) -> Tolerance {
        self.tolerance
    }

    /// The refusal that the file expects, if it does.
    #[must_use]
    pub fn error(&self) -> Option<&'a str> {
        self.error
    }

    /// The input's value at `key`, if present and not null.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&'a Value> {
        self.input.get(key).filter(|value| !value.is_null())
    }

    /// The number at `key`. The strings NaN, Infinity and -Infinity are numbers here.
    ///
    /// # Panics
    ///
    /// If there is none: the case then fails.
    #[must_use]
    #[expect(clippy::panic, reason = "a malformed case fails by name")]
    pub fn number(&self, key: &str) -> f64 {
        self.get(key)
            .and_then(number)
            .unwrap_or_else(|| panic!("input has no number {key}"))
    }

    /// The list of numbers at `key`.
    ///
    /// # Panics
    ///
    /// If there is none: the case then fails.
    #[must_use]
    #[expect(clippy::panic, reason = "a malformed case fails by name")]
    pub fn numbers(&self, key: &str) -> Vec<f64> {
        self.get(key)
            .and_then(numbers)
            .unwrap_or_else(|| panic!("input has no list of numbers {key}"))
    }

    /// The list of lists of numbers (points, rows) at `key`.
    ///
    /// # Panics
    ///
    /// If there is none: the case then fails.
    #[must_use]
    #[expect(clippy::panic, reason = "a malformed case fails by name")]
    pub fn rows(&self, key: &str) -> Vec<Vec<f64>> {
        self.get(key)
            .and_then(rows)
            .unwrap_or_else(|| panic!("input has no list of lists of numbers {key}"))
    }

    /// Says that the answer is `got` where the file expects `key`: numbers within the tolerance, all else equal. A key
    /// that the file does not list is not compared.
    pub fn compare(&self, key: &str, got: impl Into<Value>) {
        self.compare_within(key, got, self.tolerance);
    }

    /// As [`Case::compare`], with a tolerance of this key alone; the caller argues for it.
    pub fn compare_within(&self, key: &str, got: impl Into<Value>, tolerance: Tolerance) {
        self.seen(key);
        if let Some(error) = self.error {
            self.fail(format!(
                "{key} was computed where the refusal \"{error}\" is expected"
            ));
        } else if let Some(want) = self.expected.get(key)
            && let Err(difference) = tolerance.compare(want, &got.into())
        {
            self.fail(format!("{key}: {difference}"));
        }
    }

    /// Says that the answer is a refusal of the kind `category`; `matches` says whether the file's words mean it.
    pub fn refuse(&self, category: &str, matches: impl Fn(&str) -> bool) {
        match self.error {
            Some(words) if matches(words) => {}
            Some(words) => self.fail(format!("refused with \"{category}\", expected \"{words}\"")),
            None => self.fail(format!("refused with \"{category}\", expected an answer")),
        }
        self.seen("error");
    }

    /// Fails unless `holds`, with `words` to say what does not.
    pub fn require(&self, holds: bool, words: &str) {
        if !holds {
            self.fail(words.to_owned());
        }
    }

    /// Marks an expected key as judged by other means.
    pub fn seen(&self, key: &str) {
        self.read.borrow_mut().insert(key.to_owned());
    }

    /// Fails because the test does not know this kind of case.
    pub fn unknown_kind(&self) {
        self.fail("unknown kind of case".to_owned());
        if let Some(keys) = self.expected.as_object() {
            keys.keys().for_each(|key| self.seen(key));
        }
    }

    /// Fails with `words`.
    pub fn fail(&self, words: String) {
        self.failures.borrow_mut().push(words);
    }

    fn fail_unread(&self) {
        let read = self.read.borrow();
        if let Some(error) = self.error {
            if !read.contains("error") && self.failures.borrow().is_empty() {
                self.fail(format!(
                    "the refusal \"{error}\" is expected and none was given"
                ));
            }
        } else if let Some(keys) = self.expected.as_object().filter(|keys| !keys.is_empty()) {
            for key in keys.keys().filter(|key| !read.contains(*key)) {
                self.fail(format!("expected key {key} was not looked at"));
            }
        } else if self.failures.borrow().is_empty() {
            self.fail("neither values nor a refusal are expected".to_owned());
        }
    }
}

/// A JSON number, or one of the strings NaN, Infinity, -Infinity.
#[must_use]
pub fn number(value: &Value) -> Option<f64> {
    match value {
        Value::String(words) => match words.as_str() {
            "NaN" => Some(f64::NAN),
            "Infinity" => Some(f64::INFINITY),
            "-Infinity" => Some(f64::NEG_INFINITY),
            _ => None,
        },
        _ => value.as_f64(),
    }
}

/// A list of [`number`]s.
#[must_use]
pub fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(number).collect()
}

/// A list of lists of [`number`]s.
#[must_use]
pub fn rows(value: &Value) -> Option<Vec<Vec<f64>>> {
    value.as_array()?.iter().map(numbers).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn run(kind: &str, expected: &Value, answer: impl Fn(&Case<'_>)) -> Result<(), String> {
        let input = json!({"a": 2.0, "far": "Infinity"});
        let case = Case::new("the case", kind, &input)
            .expecting(expected, Tolerance::RelativeToLargest(1e-12));
        catch_unwind(AssertUnwindSafe(|| judge("unit", [case], answer)))
            .map_err(|panic| panic.downcast_ref::<String>().cloned().unwrap_or_default())
    }

    #[test]
    fn a_right_answer_passes() {
        run("k", &json!({"x": 2.0}), |case| {
            case.compare("x", case.number("a"))
        })
        .unwrap();
        run("k", &json!({"x": "Infinity"}), |case| {
            case.compare("x", "Infinity")
        })
        .unwrap();
    }

    #[test]
    fn a_wrong_answer_an_unread_key_and_an_unknown_kind_fail_by_name() {
        for (expected, answer) in [
            (
                json!({"x": 2.1}),
                (|case| case.compare("x", case.number("a"))) as fn(&Case<'_>),
            ),
            (json!({"x": 2.0, "y": 1}), |case| {
                case.compare("x", case.number("a"))
            }),
            (json!({"x": 2.0}), |case| case.unknown_kind()),
            (json!({"x": 2.0}), |case| {
                case.compare("x", case.number("missing"))
            }),
            (json!({"error": "no"}), |case| case.compare("x", 2.0)),
            (json!({"error": "no"}), |_| {}),
            (json!({"error": "no"}), |case| {
                case.refuse("yes", |words| words == "yes")
            }),
        ] {
            let failure = run("k", &expected, answer).unwrap_err();
            assert!(failure.contains("the case [k]"), "{failure}");
        }
    }

    #[test]
    fn a_case_that_expects_nothing_fails() {
        for expected in [json!({}), Value::Null, json!({"error": 3})] {
            assert!(run("k", &expected, |case| case.compare("x", 2.0)).is_err());
        }
    }

    #[test]
    fn a_list_is_found_at_its_key_and_nowhere_else() {
        let file = json!({"about": "words", "cases": [{"kind": "k"}]});
        assert_eq!(list_at(&file, "cases").len(), 1);
        assert!(list_at(&json!({"about": "words"}), "cases").is_empty());
        for file in [
            json!({"cases": 3}),
            json!({"cases": [], "more": [{"kind": "k"}]}),
        ] {
            assert!(catch_unwind(|| list_at(&file, "cases").len()).is_err());
        }
    }

    #[test]
    fn a_file_without_cases_fails() {
        assert!(catch_unwind(|| judge("empty", [], |_| {})).is_err());
    }

    #[test]
    fn an_expected_refusal_is_judged_by_its_words() {
        run("k", &json!({"error": "zero radius"}), |case| {
            case.refuse("radius", |words| words.contains("radius"))
        })
        .unwrap();
    }
}
