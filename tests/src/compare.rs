//! Comparison of an answer with the expected JSON value.

use serde_json::Value;

use crate::number;

/// How far a number may be from the expected one. Strings, booleans and nulls are compared exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// `|got - want| <= tolerance * max(1, largest |want| in the same list)`.
    RelativeToLargest(f64),
    /// `|got - want| <= tolerance * (1 + |want|)`, number by number.
    Componentwise(f64),
    /// `|got - want| <= tolerance * max(1, |want|)`, number by number.
    ComponentwiseMax(f64),
    /// `|got - want| <= tolerance`.
    Absolute(f64),
}

impl Tolerance {
    /// Compares recursively; the error says where and by how much the two differ.
    ///
    /// # Errors
    ///
    /// A sentence with the place and both values.
    pub fn compare(self, want: &Value, got: &Value) -> Result<(), String> {
        self.compare_in(want, got, 1.0)
    }

    /// Whether the number `got` is close enough to `want`.
    #[must_use]
    pub fn close(self, want: f64, got: f64) -> bool {
        self.allowance(want, want.abs().max(1.0)) >= (got - want).abs()
            || got == want
            || (got.is_nan() && want.is_nan())
    }

    fn allowance(self, want: f64, scale: f64) -> f64 {
        match self {
            Self::RelativeToLargest(tolerance) => tolerance * scale,
            Self::Componentwise(tolerance) => tolerance * (1.0 + want.abs()),
            Self::ComponentwiseMax(tolerance) => tolerance * want.abs().max(1.0),
            Self::Absolute(tolerance) => tolerance,
        }
    }

    fn compare_in(self, want: &Value, got: &Value, scale: f64) -> Result<(), String> {
        match (want, got) {
            (Value::Array(wants), Value::Array(gots)) => {
                if wants.len() != gots.len() {
                    return Err(format!(
                        "{} entries, expected {}: got {got}, want {want}",
                        gots.len(),
                        wants.len()
                    ));
                }
                let scale = wants
                    .iter()
                    .filter_map(number)
                    .fold(1.0_f64, |most, entry| most.max(entry.abs()));
                for (index, (want, got)) in wants.iter().zip(gots).enumerate() {
                    self.compare_in(want, got, scale)
                        .map_err(|words| format!("[{index}] {words}"))?;
                }
                Ok(())
            }
            (Value::Object(wants), Value::Object(gots)) => {
                for (key, want) in wants {
                    let got = gots.get(key).ok_or_else(|| format!("no entry {key}"))?;
                    self.compare_in(want, got, 1.0)
                        .map_err(|words| format!("{key} {words}"))?;
                }
                Ok(())
            }
            _ => match (number(want), number(got)) {
                (Some(want), Some(got)) => {
                    let scale = scale.max(want.abs());
                    let equal = want == got || (want.is_nan() && got.is_nan());
                    if equal || (got - want).abs() <= self.allowance(want, scale) {
                        Ok(())
                    } else {
                        Err(format!(
                            "got {got:e}, want {want:e}, difference {:e}",
                            got - want
                        ))
                    }
                }
                _ if want == got => Ok(()),
                _ => Err(format!("got {got}, want {want}")),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_list_is_judged_against_its_largest_entry() {
        let tolerance = Tolerance::RelativeToLargest(1e-3);
        assert!(
            tolerance
                .compare(&json!([1000.0, 0.0]), &json!([1000.0, 0.5]))
                .is_ok()
        );
        assert!(
            tolerance
                .compare(&json!([1.0, 0.0]), &json!([1.0, 0.5]))
                .is_err()
        );
    }

    #[test]
    fn the_kinds_of_value_are_told_apart() {
        let tolerance = Tolerance::Absolute(1e-3);
        assert!(tolerance.compare(&json!(true), &json!(1.0)).is_err());
        assert!(tolerance.compare(&json!("a"), &json!("b")).is_err());
        assert!(
            tolerance
                .compare(&json!([1.0]), &json!([1.0, 2.0]))
                .is_err()
        );
        assert!(
            tolerance
                .compare(&json!({"k": 1.0}), &json!({"k": 1.0, "more": 2}))
                .is_ok()
        );
        assert!(tolerance.compare(&json!({"k": 1.0}), &json!({})).is_err());
        assert!(tolerance.compare(&json!("NaN"), &json!("NaN")).is_ok());
        assert!(tolerance.compare(&json!(1.0), &json!(f64::NAN)).is_err());
    }
}
