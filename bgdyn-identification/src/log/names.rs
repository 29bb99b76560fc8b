//! Names of the columns.

/// What a column of a joint contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Time.
    Time,
    /// Position.
    Position,
    /// Effort.
    Effort,
}

/// Patterns of the names; `{}` is the name of a joint, or its number from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColumnNames {
    /// Of the time.
    pub time: String,
    /// Of positions.
    pub q: String,
    /// Of efforts.
    pub tau: String,
}

impl Default for ColumnNames {
    fn default() -> Self {
        ColumnNames {
            time: "time".into(),
            q: "q_{}".into(),
            tau: "tau_{}".into(),
        }
    }
}

impl ColumnNames {
    /// Reads `q=joint_{}_pos,tau=joint_{}_effort,time=stamp`.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut names = ColumnNames::default();
        for part in text.split(',') {
            let Some((key, pattern)) = part.split_once('=') else {
                return Err(format!(
                    "`{part}` is no `KEY=PATTERN`, such as `q=joint_{{}}_pos`"
                ));
            };
            let (place, braces) = match key.trim() {
                "time" => (&mut names.time, false),
                "q" => (&mut names.q, true),
                "tau" => (&mut names.tau, true),
                other => return Err(format!("no key `{other}`: there are `time`, `q`, `tau`")),
            };
            if braces && pattern.matches("{}").count() != 1 {
                return Err(format!(
                    "`{pattern}` needs one `{{}}`, for the name of the joint"
                ));
            }
            *place = pattern.trim().to_owned();
        }
        Ok(names)
    }

    /// Returns the names that a column of a joint may have: by the joint's name or number, and `q1` for `q_1`.
    pub fn of_joint(&self, quantity: Quantity, name: &str, number: usize) -> Vec<String> {
        let pattern = match quantity {
            Quantity::Time => return vec![self.time.clone()],
            Quantity::Position => &self.q,
            Quantity::Effort => &self.tau,
        };
        let number = number.to_string();
        let close = pattern.replace("_{}", "{}");
        let names = [(pattern, name), (pattern, &number), (&close, &number)];
        names
            .map(|(pattern, own)| pattern.replace("{}", own))
            .to_vec()
    }
}
