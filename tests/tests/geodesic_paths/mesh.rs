//! Meshes, locally shortest paths and straightest traces.

use geodesic::glam::DVec3;
use geodesic::{Error, Mesh, PathFinder, Pivot, Start, Stop, Straightest, SurfacePoint, next};
use integration_tests::{Case, number, numbers, rows};
use serde_json::{Value, json};

use crate::exact;

/// The mesh of a case, in strict mode.
pub(crate) fn mesh(case: &Case<'_>) -> Result<Mesh, Error> {
    let input = case.get("mesh").expect("a mesh");
    let positions: Vec<DVec3> = rows(&input["vertices"])
        .expect("vertices")
        .iter()
        .map(|p| DVec3::from_slice(p))
        .collect();
    // An index that is no index at all is out of range.
    let index = |value: &Value| {
        value
            .as_u64()
            .and_then(|i| u32::try_from(i).ok())
            .unwrap_or(u32::MAX)
    };
    let faces: Vec<Vec<u32>> = input["faces"]
        .as_array()
        .expect("faces")
        .iter()
        .map(|face| face.as_array().expect("a face").iter().map(index).collect())
        .collect();
    Mesh::new_strict(&positions, &faces)
}

/// A point as the files write it: `["v", i]`, `["e", i, j, t]` or `["f", k, [l0, l1, l2]]`.
pub(crate) fn point(mesh: &Mesh, value: &Value) -> Result<SurfacePoint, Error> {
    let index = |k: usize| value[k].as_u64().map_or(u32::MAX, |i| i as u32);
    match value[0].as_str() {
        Some("v") => mesh.vertex_point(index(1)),
        Some("e") => mesh.edge_point(index(1), index(2), number(&value[3]).expect("a parameter")),
        Some("f") => {
            let weights = numbers(&value[2]).expect("weights");
            mesh.face_point(index(1), weights.try_into().expect("three weights"))
        }
        _ => panic!("unknown kind of point {value}"),
    }
}

/// Words by which the files name a refusal.
fn names(error: &Error, words: &str) -> bool {
    let any = |list: &[&str]| list.iter().any(|part| words.contains(part));
    match error {
        Error::EmptyMesh => any(&["empty", "no face", "without faces"]),
        Error::NonFiniteVertex { .. } | Error::NonFinite { .. } => {
            any(&["non-finite", "not finite", "NaN"])
        }
        Error::NotATriangle { .. } => any(&["triangle"]),
        Error::IndexOutOfRange { .. } | Error::NoSuchVertex { .. } | Error::NoSuchFace { .. } => {
            any(&["out of range"])
        }
        Error::RepeatedVertex { .. } | Error::DegenerateFace { .. } => any(&["degenerate"]),
        Error::NonManifoldEdge { .. } => {
            any(&["edge shared by", "non-manifold edge", "more than two faces"])
        }
        Error::InconsistentOrientation { .. } | Error::RepeatedFace { .. } => any(&[
            "same direction",
            "orientation",
            "directed edge",
            "repeated face",
            "duplicate",
        ]),
        Error::NonManifoldVertex { .. } => any(&["non-manifold vertex", "one fan"]),
        Error::UnreferencedVertex { .. } => any(&["without faces", "unreferenced"]),
        Error::NoPath { .. } => any(&["no path"]),
        Error::NoTangentialPart { .. } => any(&["tangential"]),
        Error::OutsideFace { .. } | Error::OutsideEdge { .. } => {
            any(&["outside", "negative", "sum"])
        }
        Error::DirectionLeavesFace { .. } => any(&["out of the", "leaves", "points out"]),
        Error::InvalidLength { .. } => any(&["length"]),
        _ => false,
    }
}

fn refuse(case: &Case<'_>, error: &Error) {
    case.refuse(&error.to_string(), |words| names(error, words));
}

/// Answers a case, or says that its kind is another's.
pub(crate) fn answer(case: &Case<'_>) -> bool {
    let answered = match case.kind() {
        "mesh_validation" => mesh_validation(case),
        "mesh_geodesic" => mesh_geodesic(case),
        "taut_path_in_sequence" => taut_path_in_sequence(case),
        "trace" => trace(case),
        _ => return false,
    };
    if let Err(error) = answered {
        refuse(case, &error);
    }
    true
}

fn mesh_validation(case: &Case<'_>) -> Result<(), Error> {
    let mesh = mesh(case)?;
    case.seen("oracle_message");
    case.compare("faces", mesh.face_count());
    Ok(())
}

fn mesh_geodesic(case: &Case<'_>) -> Result<(), Error> {
    let mesh = mesh(case)?;
    let (from, to) = (
        point(&mesh, &case.input()["start"])?,
        point(&mesh, &case.input()["end"])?,
    );
    exact::shortest(case, &mesh, from, to);
    let exact = number(&case.expected()["exact_shortest"]);
    for start in [Start::Faces, Start::Edges, Start::Vertices] {
        // The file's own path begins with the faces, and its class is kept.
        let neighbours = start != Start::Faces;
        let mut finder = PathFinder::new(&mesh)
            .with_start(start)
            .with_neighbouring_classes(neighbours);
        let path = finder.shortest(from, to)?.clone();
        case.require(
            path.certify(&mesh)?.is_geodesic(),
            &format!("{start:?}: not certified"),
        );
        case.require(
            exact.is_none_or(|exact| path.length() >= exact * (1.0 - 1e-12)),
            &format!("{start:?}: shorter than the shortest"),
        );
        let reference = number(&case.expected()["reference_local_length"]);
        let same = reference.is_none_or(|length| case.tolerance().close(length, path.length()));
        if start == Start::Faces && (same || case.expected()["local_is_global"] != json!(false)) {
            case.compare("reference_local_length", path.length());
            let pivots = path.pivots();
            case.compare(
                "critical_vertices",
                pivots.iter().map(|p| p.vertex).collect::<Vec<_>>(),
            );
            compare_sides(case, pivots);
        } else {
            // Where the reference is not the global path, any other certified one is as good.
            for key in ["reference_local_length", "critical_vertices", "side_angles"] {
                case.seen(key);
            }
        }
        case.seen("local_is_global");
        if case.expected()["local_is_global"] == json!(true) && start == Start::Faces {
            case.require(
                exact.is_none_or(|exact| case.tolerance().close(exact, path.length())),
                "the local path is not the global one",
            );
        }
    }
    Ok(())
}

/// Side angles as unordered pairs; `null` where the boundary lies.
fn compare_sides(case: &Case<'_>, pivots: &[Pivot]) {
    let sort = |a: Option<f64>, b: Option<f64>| {
        if a.unwrap_or(9e9) <= b.unwrap_or(9e9) {
            json!([a, b])
        } else {
            json!([b, a])
        }
    };
    case.seen("side_angles");
    let Some(wanted) = case.expected()["side_angles"].as_array() else {
        return;
    };
    let wanted: Vec<Value> = wanted
        .iter()
        .map(|pair| sort(number(&pair[0]), number(&pair[1])))
        .collect();
    let got: Vec<Value> = pivots
        .iter()
        .map(|pivot| sort(pivot.left, pivot.right))
        .collect();
    if let Err(difference) = case.tolerance().compare(&json!(wanted), &json!(got)) {
        case.fail(format!("side_angles: {difference}"));
    }
}

fn taut_path_in_sequence(case: &Case<'_>) -> Result<(), Error> {
    let mesh = mesh(case)?;
    let (from, to) = (
        point(&mesh, &case.input()["start"])?,
        point(&mesh, &case.input()["end"])?,
    );
    let sequence: Vec<u32> = case.numbers("sequence").iter().map(|&f| f as u32).collect();
    let mut finder = PathFinder::new(&mesh);
    let trimmed = finder.trimmed(&sequence, from, to)?;
    case.compare("trimmed_sequence", trimmed.clone());
    let path = finder.taut(&sequence, from, to)?;
    case.compare("length", path.length());
    let pivots = path.pivots();
    case.compare(
        "path_vertices",
        pivots.iter().map(|p| p.vertex).collect::<Vec<_>>(),
    );
    // The side of the sequence is the one on which its faces lie: there the angle is at least π.
    let (mut inside, mut complement) = (Vec::new(), Vec::new());
    for pivot in pivots {
        let portal = path_side(&mesh, &trimmed, pivot.vertex);
        let (here, there) = if portal {
            (pivot.right, pivot.left)
        } else {
            (pivot.left, pivot.right)
        };
        inside.push(here);
        complement.push(there);
    }
    case.compare("side_angle_inside", json!(inside));
    case.compare("side_angle_complement", json!(complement));
    Ok(())
}

/// Whether a vertex is on the left of a sequence of faces, so that the faces are on its right.
fn path_side(mesh: &Mesh, sequence: &[u32], vertex: u32) -> bool {
    let corners = mesh.faces().as_flattened();
    sequence
        .windows(2)
        .filter_map(|pair| {
            (3 * pair[0]..3 * pair[0] + 3).find(|&h| mesh.twin(h).is_some_and(|t| t / 3 == pair[1]))
        })
        .any(|portal| corners[next(portal) as usize] == vertex)
}

fn trace(case: &Case<'_>) -> Result<(), Error> {
    let mesh = mesh(case)?;
    let face = case.number("face") as u32;
    let weights = case.numbers("bary").try_into().expect("three weights");
    let direction = DVec3::from_slice(&case.numbers("direction"));
    let tracer = match case.get("vertex_normals") {
        None => Straightest::new(&mesh),
        Some(normals) => {
            let normals: Vec<DVec3> = rows(normals)
                .expect("normals")
                .iter()
                .map(|n| DVec3::from_slice(n))
                .collect();
            Straightest::new(&mesh).with_normals(&normals)?
        }
    };
    let length = case.number("length");
    let trace = tracer.trace(mesh.face_point(face, weights)?, face, direction, length)?;
    case.compare(
        "end",
        trace.positions.last().expect("an end").to_array().to_vec(),
    );
    case.compare("end_direction", trace.end_direction.to_array().to_vec());
    let stop = match trace.stop {
        Stop::Length => "length",
        Stop::BoundaryEdge => "boundary edge",
        Stop::BoundaryVertex => "boundary vertex",
        _ => "step limit",
    };
    case.compare("stop", stop);
    case.compare("travelled", trace.length);
    case.compare("crossings", trace.crossings());
    // The trace of the file goes once round and a little further.
    if let Some((arc_length, gap)) = trace.nearest_return(length / 2.0) {
        case.compare("loop_length", arc_length);
        case.compare("closing_gap", gap);
    }
    Ok(())
}
