//! Loading, building, locally shortest paths and exact distances, on a mesh and pairs of the user's so that a peer can be timed beside
//! us: `--mesh FILE.obj --pairs FILE.json` with `[[v0, v1], ...]`, vertex numbers in file order.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::Result;
use geodesic::{Mesh, PathFinder, Sweep, TriangleSoup, shapes};
use serde_json::{Value, json};

use super::{Bench, Timer};
use crate::demo::OrBadInput;

/// Rounds over all pairs; the last one is reported, when buffers have grown and caches are warm.
const ROUNDS: usize = 3;

/// Processor time is counted in ticks of up to ten milliseconds: it says more than the clock after ten of them.
const MANY_TICKS_MS: f64 = 100.0;

#[derive(clap::Args, Debug)]
pub(super) struct Geodesic {
    /// An OBJ file [default: a subdivided icosahedron of 20,480 triangles]
    #[arg(long, value_name = "FILE")]
    mesh: Option<PathBuf>,
    /// Vertex pairs, `[[v0, v1], ...]` [default: 120 random pairs]
    #[arg(long, value_name = "FILE")]
    pairs: Option<PathBuf>,
}

impl Bench for Geodesic {
    const NAME: &'static str = "geodesic";
    const ABOUT: &'static str = "Paths on a mesh: load, build, locally shortest, exact";

    fn run(&self, _: &Timer) -> Result<Value> {
        let mut result = serde_json::Map::new();
        let soup = match &self.mesh {
            Some(path) => {
                let (soup, ms) = on_processor(|| TriangleSoup::read_obj(path));
                result.insert("load_ms".into(), json!(ms));
                let options = tobj::LoadOptions::default();
                let (parsed, ms) = on_processor(|| tobj::load_obj(path, &options));
                // Only the time counts; the materials may be missing.
                let (_models, _materials) = parsed.or_bad_input("--mesh FILE")?;
                result.insert("tobj_ms".into(), json!(ms));
                soup.or_bad_input("--mesh FILE")?
            }
            None => shapes::sphere(5)?.into(),
        };
        // The median of three: the first one pays for fresh memory.
        let mut builds: Vec<f64> = (0..ROUNDS)
            .map(|_| timed(|| Mesh::new(&soup.positions, &soup.faces)).1)
            .collect();
        let mesh = Mesh::new(&soup.positions, &soup.faces).or_bad_input("--mesh FILE")?;
        result.insert("triangles".into(), json!(mesh.face_count()));
        result.insert("mesh_bytes".into(), json!(mesh.bytes()));
        result.insert("build_ms".into(), json!(median(&mut builds)));
        let pairs = self.pairs(&mesh)?;
        local(&mesh, &pairs, &mut result)?;
        exact(&mesh, &pairs, &mut result)?;
        result.insert("peak_bytes".into(), json!(peak_bytes()));
        Ok(Value::Object(result))
    }
}

impl Geodesic {
    fn pairs(&self, mesh: &Mesh) -> Result<Vec<[u32; 2]>> {
        if let Some(path) = &self.pairs {
            let text = std::fs::read_to_string(path).or_bad_input("--pairs FILE")?;
            return serde_json::from_str(&text).or_bad_input("--pairs FILE");
        }
        let mut state = 1_u64;
        let mut vertex = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            ((state >> 33) as usize % mesh.vertex_count()) as u32
        };
        Ok((0..120).map(|_| [vertex(), vertex()]).collect())
    }
}

/// Times every pair: the whole query and its initial path alone.
fn local(
    mesh: &Mesh,
    pairs: &[[u32; 2]],
    result: &mut serde_json::Map<String, Value>,
) -> Result<()> {
    let mut finder = PathFinder::new(mesh);
    let (mut whole, mut initial, mut lengths) = (Vec::new(), Vec::new(), Vec::new());
    let mut not_geodesic = 0;
    for round in 0..ROUNDS {
        whole.clear();
        initial.clear();
        for &[from, to] in pairs {
            let (from, to) = (mesh.vertex_point(from), mesh.vertex_point(to));
            let (from, to) = (
                from.or_bad_input("--pairs FILE")?,
                to.or_bad_input("--pairs FILE")?,
            );
            whole.push(timed(|| finder.shortest(from, to).map(drop)).1);
            initial.push(timed(|| finder.search_only(from, to)).1);
            if round + 1 == ROUNDS {
                let path = finder.shortest(from, to).or_bad_input("--pairs FILE")?;
                lengths.push(path.length());
                not_geodesic += usize::from(!path.certify(mesh)?.is_geodesic());
            }
        }
    }
    let mut shorten: Vec<f64> = whole
        .iter()
        .zip(&initial)
        .map(|(w, i)| (w - i).max(0.0))
        .collect();
    result.insert("pairs".into(), json!(pairs.len()));
    result.insert("local_median_ms".into(), json!(median(&mut whole)));
    result.insert("initial_median_ms".into(), json!(median(&mut initial)));
    result.insert("shorten_median_ms".into(), json!(median(&mut shorten)));
    result.insert("not_geodesic".into(), json!(not_geodesic));
    result.insert("lengths".into(), json!(lengths));
    Ok(())
}

/// Times exact distances: from one vertex to all, and of every pair.
fn exact(
    mesh: &Mesh,
    pairs: &[[u32; 2]],
    result: &mut serde_json::Map<String, Value>,
) -> Result<()> {
    let mut sweep = Sweep::new(mesh);
    let source = pairs.first().map_or(0, |pair| pair[0]);
    let mut sweeps = Vec::new();
    for _ in 0..ROUNDS {
        let (swept, ms) = on_processor(|| sweep.vertex_distances(&[source.into()]).map(drop));
        swept.or_bad_input("--pairs FILE")?;
        sweeps.push(ms);
    }
    result.insert("exact_sweep_bytes".into(), json!(sweep.bytes()));
    let (mut times, mut lengths) = (Vec::new(), Vec::new());
    for &[from, to] in pairs {
        let (distance, ms) = timed(|| sweep.distance(from.into(), to.into()));
        lengths.push(distance.or_bad_input("--pairs FILE")?);
        times.push(ms);
    }
    // What answers for any point takes more memory: after the pairs, so that it does not count for them.
    let mut fields = Vec::new();
    for _ in 0..ROUNDS {
        let (field, ms) = on_processor(|| sweep.from_points(&[source.into()]).map(drop));
        field.or_bad_input("--pairs FILE")?;
        fields.push(ms);
    }
    result.insert("exact_sweep_ms".into(), json!(median(&mut sweeps)));
    result.insert("exact_field_ms".into(), json!(median(&mut fields)));
    result.insert("exact_field_bytes".into(), json!(sweep.bytes()));
    result.insert("exact_pair_median_ms".into(), json!(median(&mut times)));
    result.insert("exact_lengths".into(), json!(lengths));
    Ok(())
}

/// What a call gives, and its time in milliseconds.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let value = work();
    (value, start.elapsed().as_secs_f64() * 1e3)
}

/// What a call gives, and the processor time that this thread took for it, in milliseconds, where the system tells: other
/// programs that run at the same time do not count. The time that has passed for short calls: the system counts by ticks.
fn on_processor<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let before = processor_nanoseconds();
    let (value, elapsed) = timed(work);
    let used = processor_nanoseconds()
        .zip(before)
        .map(|(after, before)| (after - before) as f64 * 1e-6)
        .filter(|_| elapsed > MANY_TICKS_MS);
    (value, used.unwrap_or(elapsed))
}

/// The processor time of this thread so far.
fn processor_nanoseconds() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok()
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The most memory that this process has had, in bytes, where the system says it.
fn peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(1024 * kilobytes)
}
