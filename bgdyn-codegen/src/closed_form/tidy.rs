//! Rewrites sums of sines and cosines as products and squares if that is shorter.

use super::definition::{Definition, Letters};
use super::form::Atom;
use super::polynomial::{Angle, Monomial, Symbol, combined, signed};

/// Sines (`true`) and cosines of one group: none, one, or a product of two.
type Waves = Vec<(bool, Angle)>;

/// A group, and the waves of two terms in it.
type AngleDifference<'a> = (usize, &'a [(bool, Angle)], &'a [(bool, Angle)]);

/// A term of a coefficient: a sum of letters times powers of positions and run-time parameters, sines and
/// cosines.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub definition: Definition,
    powers: Vec<(Symbol, u32)>,
    /// By group, in increasing order, without empty ones.
    waves: Vec<(usize, Waves)>,
}

impl Entry {
    /// Returns the factors of a monomial other than letters.
    pub fn new(powers: Vec<(Symbol, u32)>, monomial: &Monomial) -> Self {
        let waves = monomial.waves.iter();
        Entry {
            definition: Definition::default(),
            powers,
            waves: waves
                .map(|w| (w.group, vec![(w.sine, w.angle.clone())]))
                .collect(),
        }
    }

    /// Adds to its sum of letters.
    pub fn add(&mut self, letters: Letters, value: bgdyn_runtime::Dd) {
        self.definition.add(letters, value);
    }

    /// Returns its factors without the letters, in printed order.
    pub fn shape(&self) -> Vec<(Atom, u32)> {
        let mut shape: Vec<(Atom, u32)> = Vec::new();
        for &(symbol, n) in &self.powers {
            let atom = match symbol {
                Symbol::Letter(l) => Atom::Letter(l),
                Symbol::Position(j) => Atom::Position(j),
                Symbol::Velocity(j) => Atom::Velocity(j),
                Symbol::Acceleration(j) => Atom::Acceleration(j),
            };
            shape.push((atom, n));
        }
        let mut waves: Vec<Atom> = Vec::new();
        for (sine, angle) in self.waves.iter().flat_map(|(_, waves)| waves) {
            let angle = angle.clone();
            waves.push(if *sine {
                Atom::Sine(angle)
            } else {
                Atom::Cosine(angle)
            });
        }
        waves.sort();
        for wave in waves {
            match shape.last_mut() {
                Some((last, n)) if *last == wave => *n += 1,
                _ => shape.push((wave, 1)),
            }
        }
        shape
    }

    /// Returns the group in which two entries differ, if there is only one, with the waves of each in it.
    fn differs<'a>(&'a self, other: &'a Self) -> Option<AngleDifference<'a>> {
        if self.powers != other.powers {
            return None;
        }
        let groups = self.waves.iter().chain(&other.waves).map(|(g, _)| *g);
        let mut found: Option<AngleDifference<'_>> = None;
        for group in groups {
            let (a, b) = (self.of(group), other.of(group));
            if a != b && found.is_some_and(|(g, ..)| g != group) {
                return None;
            }
            if a != b {
                found = Some((group, a, b));
            }
        }
        found
    }

    /// Returns its waves of a group.
    fn of(&self, group: usize) -> &[(bool, Angle)] {
        let found = self.waves.iter().find(|(g, _)| *g == group);
        found.map_or(&[], |(_, waves)| waves)
    }

    /// Returns the entry with other waves of a group.
    fn with(&self, group: usize, mut waves: Waves, definition: Definition) -> Self {
        waves.sort();
        let mut entry = self.clone();
        entry.waves.retain(|(g, _)| *g != group);
        entry.waves.push((group, waves));
        entry.waves.sort();
        entry.definition = definition;
        entry
    }
}

/// Returns the same sum with fewer terms, and without cosines of double angles next to a constant.
pub(super) fn tidy(mut entries: Vec<Entry>) -> Vec<Entry> {
    entries.retain(|e| e.definition.len() > 0);
    while let Some((i, j, merged)) = pairs(&entries).find_map(|(i, j)| {
        let merged = product(&entries[i], &entries[j])?;
        Some((i, j, merged))
    }) {
        entries[i] = merged;
        entries.remove(j);
    }
    while let Some((i, j, [constant, square])) = pairs(&entries)
        .flat_map(|(i, j)| [(i, j), (j, i)])
        .find_map(|(i, j)| Some((i, j, squared(&entries[i], &entries[j])?)))
    {
        entries[i] = constant;
        entries[j] = square;
    }
    entries
}

fn pairs(entries: &[Entry]) -> impl Iterator<Item = (usize, usize)> + use<> {
    let n = entries.len();
    (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j)))
}

/// Returns the only wave, or the cosine of 0 if there is none.
fn single(waves: &[(bool, Angle)]) -> Option<(bool, &[(usize, i32)])> {
    match waves {
        [] => Some((false, &[])),
        [(sine, angle)] => Some((*sine, angle)),
        _ => None,
    }
}

/// Applies cos A + cos B = 2 cos ½(A+B) cos ½(A−B), and similar formulas, if the halves have integer
/// multiples.
fn product(a: &Entry, b: &Entry) -> Option<Entry> {
    let (group, x, y) = a.differs(b)?;
    let ((sine, x), (other, y)) = (single(x)?, single(y)?);
    let equal = b.definition.is(1.0, &a.definition);
    if sine != other || !(equal || b.definition.is(-1.0, &a.definition)) {
        return None;
    }
    let (minus_mean, mean) = signed(half(&combined(x, y, 1))?);
    let (minus_rest, rest) = signed(half(&combined(x, y, -1))?);
    // cos A − cos B = −2 sin sin; sin A + sin B = 2 sin cos; sin A − sin B = 2 cos sin
    let (of_mean, of_rest) = (sine == equal, !equal);
    let turned = (of_mean && minus_mean) ^ (of_rest && minus_rest) ^ (!sine && !equal);
    let k = if turned { -2.0 } else { 2.0 };
    let waves = vec![(of_mean, mean), (of_rest, rest)];
    let definition = Definition::default().plus(k, &a.definition);
    Some(a.with(group, waves, definition))
}

/// Applies A + B cos 2X = (A + B) − 2B sin² X = (A − B) + 2B cos² X, whichever constant is shorter.
fn squared(a: &Entry, b: &Entry) -> Option<[Entry; 2]> {
    let (group, x, y) = a.differs(b)?;
    let [(false, double)] = y else {
        return None;
    };
    if !x.is_empty() {
        return None;
    }
    let single = half(double)?;
    let by_sine = a.definition.plus(1.0, &b.definition);
    let by_cosine = a.definition.plus(-1.0, &b.definition);
    let sine = by_sine.len() <= by_cosine.len();
    let (constant, k) = if sine {
        (by_sine, -2.0)
    } else {
        (by_cosine, 2.0)
    };
    let waves = vec![(sine, single.clone()), (sine, single)];
    let square = b.with(group, waves, Definition::default().plus(k, &b.definition));
    let definition = constant;
    Some([
        Entry {
            definition,
            ..a.clone()
        },
        square,
    ])
}

/// Returns half of an angle if its multiples are all even.
fn half(angle: &[(usize, i32)]) -> Option<Angle> {
    let half = |&(j, n): &(usize, i32)| (n % 2 == 0).then_some((j, n / 2));
    angle.iter().map(half).collect()
}
