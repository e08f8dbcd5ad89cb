//! Whose fault a failure is, and the exit status that says so.

use std::fmt;

use anyhow::{Error, Result};

/// The user's flags or files are at fault: exit status 2.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadInput(pub String);

impl fmt::Display for BadInput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for BadInput {}

/// Marks the errors of reading a user's input as [`BadInput`].
pub trait OrBadInput<T> {
    /// The same, an error becoming [`BadInput`] with `what` in front of its message.
    ///
    /// # Errors
    /// [`BadInput`] where the result was an error.
    fn or_bad_input(self, what: impl fmt::Display) -> Result<T>;
}

impl<T, E: fmt::Display> OrBadInput<T> for std::result::Result<T, E> {
    fn or_bad_input(self, what: impl fmt::Display) -> Result<T> {
        self.map_err(|error| BadInput(format!("{what}: {error:#}")).into())
    }
}

/// 2 for bad input (a wrong flag included), 1 for any other failure.
#[must_use]
pub fn exit_status(error: &Error) -> u8 {
    let bad_flag = error.downcast_ref::<clap::Error>().is_some();
    if bad_flag || error.downcast_ref::<BadInput>().is_some() {
        2
    } else {
        1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::{Context, anyhow};

    #[test]
    fn bad_input_is_two_and_the_rest_is_one() {
        let missing = std::fs::read("no such file")
            .or_bad_input("--mesh")
            .unwrap_err();
        assert!(missing.to_string().starts_with("--mesh: "));
        assert_eq!(exit_status(&missing), 2);
        assert_eq!(
            exit_status(&Err::<(), _>(missing).context("while reading").unwrap_err()),
            2
        );
        assert_eq!(exit_status(&anyhow!("no convergence")), 1);
    }
}
