//! Results of the theory of blends, read from a file: their parts are checked against each other.
//!
//! Each is written as it is and read as it was written, to the last digit of its text. Building it again from what determines it would
//! change these digits, and near a limit between two classes the class.

use crate::family::Structure;
use crate::{
    Blend, Classification, Cone, ContactFamily, Dupin, Family, Tube, contact_residual, tolerance,
};
use lorentz::Cycle;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Parts of one value may disagree by this share: a class is decided at [`tolerance::CLASS`], and its sphere is off by as much from the lines
/// at a distance of some sizes.
const AGREEMENT: f64 = 1e-6;

/// What must hold between the parts of a value for it to be one of this crate's.
trait Consistent {
    fn check(&self) -> Result<(), &'static str>;
}

macro_rules! checked_when_read {
    ($($value:ident),*) => {$(
        impl Serialize for $value {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $value::serialize(self, serializer)
            }
        }

        impl<'de> Deserialize<'de> for $value {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let read = $value::deserialize(deserializer)?;
                read.check().map_err(D::Error::custom)?;
                Ok(read)
            }
        }
    )*};
}

checked_when_read!(Family, Blend, Tube, Classification);

fn require(holds: bool, reason: &'static str) -> Result<(), &'static str> {
    if holds { Ok(()) } else { Err(reason) }
}

impl Consistent for Family {
    fn check(&self) -> Result<(), &'static str> {
        require(
            self.orientation().abs() == 1 && self.pairing().abs() <= 1,
            "orientation and pairing of a family are signs",
        )?;
        require(
            self.size > 0.0 && self.size <= tolerance::LARGEST_LENGTH,
            "the size of a family is a positive length",
        )?;
        require(
            (self.axial_plane_normal().length() - 1.0).abs() <= tolerance::FRAME,
            "the normal of the axial plane is a unit vector",
        )?;
        let [first, second] = self.lines();
        let (given, expected, unit) = match self.structure {
            Structure::Meet { product, .. } => {
                let expected = first.direction().product(second.direction());
                (product, expected, expected.abs().max(1.0))
            }
            Structure::Parallel { step, square } => {
                let length = step.centre.length().hypot(step.radius);
                (square, step.square(), length * length)
            }
        };
        require(
            (given - expected).abs() <= AGREEMENT * unit,
            "the lines of a family have the product that it states",
        )?;
        for parameter in [-self.size, 0.0, self.size] {
            for (line, sphere) in self.lines().iter().zip(self.contact_spheres(parameter)) {
                let on_line = line.at(line.foot(sphere.centre));
                require(
                    agree(
                        on_line,
                        sphere,
                        self.size + line.point.distance(sphere.centre),
                    ),
                    "the contact spheres of a family are inscribed in its cones",
                )?;
            }
        }
        Ok(())
    }
}

/// Whether two spheres are one, relative to a size and their radii.
fn agree(one: Cycle, other: Cycle, size: f64) -> bool {
    let allowed = AGREEMENT * (size + one.radius.abs());
    one.centre.distance(other.centre) <= allowed && (one.radius - other.radius).abs() <= allowed
}

impl Consistent for Blend {
    fn check(&self) -> Result<(), &'static str> {
        require(
            is_of(self.surface(), self.contact_family()),
            "the contact family of a blend is one of its surface",
        )?;
        require(
            (0.0..=tolerance::BLEND).contains(&self.residual()),
            "the residual of a blend is within its tolerance",
        )?;
        let expected = self.family().contact_spheres(self.parameter());
        for ((contact, line), expected) in self
            .contacts()
            .iter()
            .zip(self.family().lines())
            .zip(expected)
        {
            let size = self.family().size + line.point.distance(expected.centre);
            let circle = line.contact_circle(expected);
            require(
                agree(contact.sphere, expected, size)
                    && agree(
                        Cycle::new(contact.circle.centre, contact.circle.radius),
                        Cycle::new(circle.centre, circle.radius),
                        size,
                    ),
                "the contacts of a blend belong to its parameter in the family",
            )?;
            let cone = Cone::of_line(line).map_err(|_| "a line of spheres belongs to a cone")?;
            let residual = contact_residual(
                self.surface(),
                self.contact_family(),
                contact.parameter,
                &cone,
            );
            require(
                residual <= 10.0 * tolerance::BLEND,
                "the surface of a blend touches the cones of its family",
            )?;
        }
        Ok(())
    }
}

impl Consistent for Tube {
    fn check(&self) -> Result<(), &'static str> {
        require(
            is_of(self.surface(), self.contact_family()),
            "the contact family of a tube is one of its surface",
        )?;
        require(
            self.sides().iter().all(|side| side.abs() == 1),
            "the sides of a tube are signs",
        )?;
        require(
            self.patches().is_ok(),
            "a tube runs from one parameter to another",
        )
    }
}

impl Consistent for Classification {
    fn check(&self) -> Result<(), &'static str> {
        require(
            self.obstacle().is_none() || self.families().is_empty(),
            "cones that cannot be blended have no families",
        )?;
        let directions = self
            .double_lines()
            .iter()
            .flat_map(|line| [line.direction, line.normal]);
        require(
            directions
                .into_iter()
                .all(|unit| (unit.length() - 1.0).abs() <= AGREEMENT),
            "directions and normals of double lines are unit vectors",
        )
    }
}

fn is_of(surface: &Dupin, contact_family: ContactFamily) -> bool {
    matches!(
        (surface, contact_family),
        (Dupin::Quartic(_), ContactFamily::Theta | ContactFamily::Psi)
            | (Dupin::Parabolic(_), ContactFamily::U | ContactFamily::V)
    )
}
