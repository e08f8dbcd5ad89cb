//! Numbers that fill the unit square evenly: Sobol points, scrambled anew for every pixel and every use.
//!
//! The scrambling is that of Burley, *Practical hash-based Owen scrambling*, JCGT 9 (4), 2020. Compared
//! with independent random numbers, soft shadows need a fraction of the rays.

/// The numbers of one ray through one pixel.
#[derive(Clone, Debug)]
pub(super) struct Sampler {
    index: u32,
    seed: u32,
    uses: u32,
}

impl Sampler {
    /// The numbers of ray `index` through pixel number `pixel`.
    pub(super) fn new(seed: u64, pixel: u64, index: u32) -> Self {
        let mixed = mix(seed ^ mix(pixel.wrapping_add(0x9e37_79b9_7f4a_7c15)));
        Self {
            index,
            seed: (mixed >> 32) as u32 ^ mixed as u32,
            uses: 0,
        }
    }

    /// The next pair in `[0, 1)`; over the rays of a pixel, the pairs of the same use are well spread.
    pub(super) fn pair(&mut self) -> [f32; 2] {
        let seed = mix(u64::from(self.seed) << 32 | u64::from(self.uses));
        self.uses += 1;
        let (shuffle, x, y) = (seed as u32, (seed >> 32) as u32, mix(seed) as u32);
        let index = scramble(self.index, shuffle);
        [
            scramble(index.reverse_bits(), x),
            scramble(second_dimension(index), y),
        ]
        .map(unit)
    }
}

/// The finaliser of splitmix64.
const fn mix(mut x: u64) -> u64 {
    x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ x >> 31
}

/// The second coordinate of Sobol's sequence: its direction numbers are the rows of Pascal's triangle
/// modulo two.
const fn second_dimension(mut index: u32) -> u32 {
    let (mut direction, mut out) = (1 << 31, 0);
    while index != 0 {
        if index & 1 == 1 {
            out ^= direction;
        }
        direction ^= direction >> 1;
        index >>= 1;
    }
    out
}

/// Owen's scrambling of the bits, each depending on those above it.
const fn scramble(x: u32, seed: u32) -> u32 {
    let mut x = x.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul(seed >> 16 | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// The upper 24 bits as a number in `[0, 1)`.
fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 / (1 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_rays_fill_sixteen_cells() {
        for pixel in 0..100 {
            for usage in 0..3 {
                for grid in [(4, 4), (16, 1), (1, 16), (2, 8)] {
                    let mut cells = [false; 16];
                    for index in 0..16 {
                        let mut sampler = Sampler::new(7, pixel, index);
                        let mut pair = sampler.pair();
                        for _ in 0..usage {
                            pair = sampler.pair();
                        }
                        let cell = (pair[0] * grid.0 as f32) as usize * grid.1
                            + (pair[1] * grid.1 as f32) as usize;
                        assert!(!cells[cell], "pixel {pixel}, use {usage}, grid {grid:?}");
                        cells[cell] = true;
                    }
                }
            }
        }
    }

    #[test]
    fn seeds_and_pixels_differ() {
        let first = |seed, pixel| Sampler::new(seed, pixel, 0).pair();
        assert_ne!(first(1, 0), first(2, 0));
        assert_ne!(first(1, 0), first(1, 1));
        assert_eq!(first(1, 5), first(1, 5));
    }
}
