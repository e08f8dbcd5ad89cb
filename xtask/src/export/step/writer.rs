//! The syntax of a STEP file: numbered entities, reals with a point, strings in quotes.

use std::fmt::Write;

use glam::DVec3;

use super::surface::{Curve, KnotVector, Surface, Weighted};

/// An entity's number.
pub(super) type Id = usize;

/// The data section as it grows.
#[derive(Debug, Default)]
pub(super) struct Writer {
    data: String,
    last: Id,
}

impl Writer {
    /// Adds an entity.
    pub(super) fn entity(&mut self, content: &str) -> Id {
        self.last += 1;
        // Writing to a String cannot fail.
        let _ = writeln!(self.data, "#{}={content};", self.last);
        self.last
    }

    pub(super) fn into_data(self) -> String {
        self.data
    }

    /// A point.
    pub(super) fn point(&mut self, p: DVec3) -> Id {
        self.entity(&format!(
            "CARTESIAN_POINT('',({},{},{}))",
            real(p.x),
            real(p.y),
            real(p.z)
        ))
    }

    /// A rational curve.
    pub(super) fn curve(&mut self, curve: &Curve) -> Id {
        let points: Vec<Id> = curve
            .control
            .iter()
            .map(|(point, _)| self.point(*point))
            .collect();
        let KnotVector {
            degree,
            knots,
            multiplicities,
        } = &curve.knots;
        self.entity(&format!(
            "(BOUNDED_CURVE()B_SPLINE_CURVE({degree},{},.UNSPECIFIED.,.F.,.F.)\
             B_SPLINE_CURVE_WITH_KNOTS({},{},.UNSPECIFIED.)CURVE()GEOMETRIC_REPRESENTATION_ITEM()\
             RATIONAL_B_SPLINE_CURVE({})REPRESENTATION_ITEM(''))",
            references(&points),
            list(multiplicities.iter().map(usize::to_string)),
            reals(knots.iter().copied()),
            weights(&curve.control),
        ))
    }

    /// A rational surface.
    pub(super) fn surface(&mut self, surface: &Surface) -> Id {
        let mut rows = Vec::new();
        for row in &surface.rows {
            let points: Vec<Id> = row.iter().map(|(point, _)| self.point(*point)).collect();
            rows.push(references(&points));
        }
        let [u, v] = &surface.knots;
        self.entity(&format!(
            "(BOUNDED_SURFACE()B_SPLINE_SURFACE({},{},{},.UNSPECIFIED.,.F.,.F.,.F.)\
             B_SPLINE_SURFACE_WITH_KNOTS({},{},{},{},.UNSPECIFIED.)GEOMETRIC_REPRESENTATION_ITEM()\
             RATIONAL_B_SPLINE_SURFACE({})REPRESENTATION_ITEM('')SURFACE())",
            u.degree,
            v.degree,
            list(rows),
            list(u.multiplicities.iter().map(usize::to_string)),
            list(v.multiplicities.iter().map(usize::to_string)),
            reals(u.knots.iter().copied()),
            reals(v.knots.iter().copied()),
            list(surface.rows.iter().map(|row| weights(row))),
        ))
    }
}

fn weights(control: &[Weighted]) -> String {
    reals(control.iter().map(|(_, weight)| *weight))
}

fn list(items: impl IntoIterator<Item = String>) -> String {
    format!("({})", items.into_iter().collect::<Vec<_>>().join(","))
}

/// `(#1,#2)`.
pub(super) fn references(ids: &[Id]) -> String {
    list(ids.iter().map(|id| format!("#{id}")))
}

fn reals(values: impl Iterator<Item = f64>) -> String {
    list(values.map(real))
}

/// A real as the format wants it: a decimal point always, the shortest digits that give the number
/// back, `E` before an exponent.
pub(super) fn real(x: f64) -> String {
    // Adding zero makes the negative zero positive.
    let text = format!("{:?}", x + 0.0);
    match text.split_once('e') {
        Some((digits, exponent)) if digits.contains('.') => format!("{digits}E{exponent}"),
        Some((digits, exponent)) => format!("{digits}.E{exponent}"),
        None => text,
    }
}

/// A text in quotes; the format knows only ASCII without an escape.
pub(super) fn quoted(text: &str) -> String {
    let plain: String = text
        .chars()
        .map(|c| {
            if c.is_ascii_graphic() || c == ' ' {
                c
            } else {
                '_'
            }
        })
        .collect();
    format!("'{}'", plain.replace('\'', "''").replace('\\', "\\\\"))
}
