//! Serialisation by serde: generated structs, joint limits, double-doubles.
//!
//! Deserialisation is strict: an unknown, missing or repeated field is an error of serde.

use core::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeStruct, Serializer};
use serde::{Deserialize, Serialize};

use crate::{Dd, Limits};

/// Implements `Serialize` and `Deserialize` for a struct of a generated module: `Name { field, … }`.
/// Without the feature `serde` it expands to nothing.
#[doc(hidden)]
#[macro_export]
macro_rules! __serde {
    ($name:ident {}) => {
        $crate::__serde! { $name [] with scalar }
    };
    ($name:ident { $($field:ident),+ $(,)? }) => {
        $crate::__serde! { $name [$($field)+] }
    };
    ($name:ident [$($field:ident)*] $(with $marker:ident)?) => {
        impl<T: $crate::Scalar + $crate::serde::Serialize> $crate::serde::Serialize for $name<T> {
            fn serialize<S: $crate::serde::Serializer>(
                &self,
                serializer: S,
            ) -> ::core::result::Result<S::Ok, S::Error> {
                let fields: &[(&'static str, &T)] = &[$((::core::stringify!($field), &self.$field)),*];
                $crate::__write_fields(serializer, ::core::stringify!($name), fields)
            }
        }
        impl<'de, T> $crate::serde::Deserialize<'de> for $name<T>
        where
            T: $crate::Scalar + $crate::serde::Deserialize<'de>,
        {
            fn deserialize<D: $crate::serde::Deserializer<'de>>(
                deserializer: D,
            ) -> ::core::result::Result<Self, D::Error> {
                const FIELDS: &[&str] = &[$(::core::stringify!($field)),*];
                let name = ::core::stringify!($name);
                let zero = <T as $crate::Scalar>::from_f64(0.0);
                let [$($field),*] = $crate::__read_fields(deserializer, name, FIELDS, zero)?;
                ::core::result::Result::Ok($name {
                    $($field,)*
                    $($marker: ::core::marker::PhantomData,)?
                })
            }
        }
    };
}

/// Serialises a struct with these fields.
#[doc(hidden)]
pub fn __write_fields<T: Serialize, S: Serializer>(
    serializer: S,
    name: &'static str,
    fields: &[(&'static str, &T)],
) -> Result<S::Ok, S::Error> {
    let mut writer = serializer.serialize_struct(name, fields.len())?;
    for &(name, value) in fields {
        writer.serialize_field(name, value)?;
    }
    writer.end()
}

/// Deserialises a struct with these fields; `space` is the initial content of their array.
#[doc(hidden)]
pub fn __read_fields<'de, T, D, const N: usize>(
    deserializer: D,
    name: &'static str,
    fields: &'static [&'static str],
    space: T,
) -> Result<[T; N], D::Error>
where
    T: Copy + Deserialize<'de>,
    D: Deserializer<'de>,
{
    let visitor = Fields {
        name,
        fields,
        needed: true,
        space,
    };
    deserializer.deserialize_struct(name, fields, visitor)
}

/// Fields of one type, as an array in their order.
struct Fields<T, const N: usize> {
    name: &'static str,
    fields: &'static [&'static str],
    /// Whether every field is required; a missing optional field has its value of `space`.
    needed: bool,
    space: T,
}

impl<'de, T: Copy + Deserialize<'de>, const N: usize> Visitor<'de> for Fields<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "struct {} with {N} fields", self.name)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<[T; N], A::Error> {
        let (mut values, mut seen) = ([self.space; N], [false; N]);
        while let Some(k) = map.next_key_seed(Key(self.fields))? {
            let (Some(value), Some(seen), Some(name)) =
                (values.get_mut(k), seen.get_mut(k), self.fields.get(k))
            else {
                return Err(A::Error::custom("a field without a place"));
            };
            if core::mem::replace(seen, true) {
                return Err(A::Error::duplicate_field(name));
            }
            *value = map.next_value()?;
        }
        let mut missing = self.fields.iter().zip(seen).filter(|(_, seen)| !seen);
        match missing.next() {
            Some((name, _)) if self.needed => Err(A::Error::missing_field(name)),
            _ => Ok(values),
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<[T; N], A::Error> {
        let mut values = [self.space; N];
        for (k, value) in values.iter_mut().enumerate() {
            let item = items.next_element()?;
            *value = item.ok_or_else(|| A::Error::invalid_length(k, &self))?;
        }
        Ok(values)
    }
}

/// A field, deserialised from its name or its index.
struct Key(&'static [&'static str]);

impl<'de> DeserializeSeed<'de> for Key {
    type Value = usize;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<usize, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for Key {
    type Value = usize;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a field")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<usize, E> {
        let found = self.0.iter().position(|name| *name == text);
        found.ok_or_else(|| E::unknown_field(text, self.0))
    }

    fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<usize, E> {
        let found = self.0.iter().position(|name| name.as_bytes() == bytes);
        found.ok_or_else(|| E::invalid_value(serde::de::Unexpected::Bytes(bytes), &self))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<usize, E> {
        let place = usize::try_from(number).ok().filter(|k| *k < self.0.len());
        place.ok_or_else(|| E::invalid_value(serde::de::Unexpected::Unsigned(number), &self))
    }
}

const LIMITS: &[&str] = &["lower", "upper", "velocity", "effort"];

/// Serialises infinite limits as `None`, because some formats have no infinities.
impl Serialize for Limits {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let stated = |x: f64, none: f64| (x != none).then_some(x);
        let (above, below) = (f64::INFINITY, f64::NEG_INFINITY);
        let values = [
            stated(self.lower, below),
            stated(self.upper, above),
            stated(self.velocity, above),
            stated(self.effort, above),
        ];
        let [lower, upper, velocity, effort] = &values;
        let fields = [
            ("lower", lower),
            ("upper", upper),
            ("velocity", velocity),
            ("effort", effort),
        ];
        __write_fields(serializer, "Limits", &fields)
    }
}

/// Deserialises a limit that is `None` or missing as infinite.
impl<'de> Deserialize<'de> for Limits {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let visitor = Fields {
            name: "Limits",
            fields: LIMITS,
            needed: false,
            space: None,
        };
        let values: [Option<f64>; 4] =
            deserializer.deserialize_struct("Limits", LIMITS, visitor)?;
        let [lower, upper, velocity, effort] = values;
        Ok(Limits {
            lower: lower.unwrap_or(f64::NEG_INFINITY),
            upper: upper.unwrap_or(f64::INFINITY),
            velocity: velocity.unwrap_or(f64::INFINITY),
            effort: effort.unwrap_or(f64::INFINITY),
        })
    }
}

/// Serialises the two words, the larger one first; no digit is lost.
impl Serialize for Dd {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.hi(), self.lo()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Dd {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (hi, lo) = <(f64, f64)>::deserialize(deserializer)?;
        Ok(Dd::from_f64(hi) + Dd::from_f64(lo))
    }
}
