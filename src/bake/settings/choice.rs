//! Enums whose values have a name and a hint, defined by one table for each enum.

/// A name that is not in the table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name} is not one of {}", .known.join(", "))]
pub struct UnknownName {
    /// The name as given.
    pub name: String,
    /// The names in the table.
    pub known: Vec<&'static str>,
}

/// Gives an enum its table: `ALL`, `name`, `hint`, `FromStr`, `Display` and `Serialize` from rows
/// `Variant: name, hint;`.
macro_rules! choice_table {
    ($choice:ident { $($variant:ident: $name:literal, $hint:literal;)+ }) => {
        impl $choice {
            /// All values, in the order in which they are offered.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            /// Name on the command line and in reports.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name),+
                }
            }

            /// Purpose of the value, in a few words.
            #[must_use]
            pub const fn hint(self) -> &'static str {
                match self {
                    $(Self::$variant => $hint),+
                }
            }
        }

        impl std::str::FromStr for $choice {
            type Err = $crate::bake::UnknownName;

            fn from_str(name: &str) -> Result<Self, Self::Err> {
                Self::ALL.into_iter().find(|value| value.name() == name).ok_or_else(|| {
                    let known = Self::ALL.map(Self::name).to_vec();
                    $crate::bake::UnknownName { name: name.to_owned(), known }
                })
            }
        }

        impl std::fmt::Display for $choice {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.name())
            }
        }

        impl serde::Serialize for $choice {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.name())
            }
        }
    };
}

pub(super) use choice_table;

#[cfg(test)]
mod tests {
    use crate::bake::{Method, Quality, Solver};

    #[test]
    fn every_value_is_found_by_its_name() {
        assert!(Quality::ALL.into_iter().all(|value| value.name().parse() == Ok(value)));
        assert!(Method::ALL.into_iter().all(|value| value.name().parse() == Ok(value)));
        assert!(Solver::ALL.into_iter().all(|value| value.name().parse() == Ok(value)));
    }

    #[test]
    fn an_unknown_name_is_refused_with_the_known_ones() {
        let error = "ultra".parse::<Quality>().expect_err("there is no such preset");
        assert_eq!(error.to_string(), "ultra is not one of draft, medium, high");
    }
}
