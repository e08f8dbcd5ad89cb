//! Polynomials on which floating-point solvers lose roots, with enclosures and multiplicities.
//!
//! `cargo run -p variation --example hard_roots`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use variation::sets::Set;
use variation::{Count, Error, Root, roots};

fn print(name: &str, coefficients: &[f64]) -> Result<(), Error> {
    println!("{name}, degree {}", coefficients.len() - 1);
    for Root { lo, hi, count } in &roots(coefficients)? {
        match count {
            Count::Exactly(1) => println!("  [{lo:.17}, {hi:.17}]"),
            Count::Exactly(multiplicity) => {
                println!("  [{lo:.17}, {hi:.17}] of multiplicity {multiplicity}")
            }
            Count::AtMost(most) => println!("  [{lo:.17}, {hi:.17}] at most {most}"),
        }
    }
    Ok(())
}

fn main() -> Result<(), Error> {
    print("3 (4t - 1)^2 (4t - 3)^2", &[27.0, -45.0, 59.0, -45.0, 27.0])?;
    print("Wilkinson", &Set::Wilkinson.polynomial(20, 0))?;
    print(
        "Mignotte, two roots 1e-10 apart",
        &Set::Mignotte.polynomial(12, 0),
    )?;
    print("Chebyshev", &Set::Chebyshev.polynomial(40, 0))
}
