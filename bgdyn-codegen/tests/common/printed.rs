//! Parses and evaluates printed equations, independently of the generator.

use std::collections::BTreeMap;
use std::iter::Peekable;
use std::str::Chars;

/// The equations parsed from the text of `bgdyn equations`.
#[derive(Debug, Default)]
pub struct Printed {
    /// Right sides of P₁, P₂, …
    pub efforts: Vec<String>,
    /// Names with their sums, and the printed values.
    pub constants: Vec<(String, String, f64)>,
    /// Letters with their values.
    pub letters: BTreeMap<String, f64>,
}

impl Printed {
    /// Reads a text.
    pub fn read(text: &str) -> Self {
        let mut printed = Printed::default();
        // A line that begins with a space continues the previous one.
        let mut lines: Vec<String> = Vec::new();
        for line in text.lines() {
            match lines.last_mut() {
                Some(last) if line.starts_with(' ') => *last += &format!("\n{line}"),
                _ => lines.push(line.to_owned()),
            }
        }
        for line in lines {
            let Some((name, right)) = line.split_once(['=', '≈']) else {
                continue;
            };
            let name = name.trim();
            if name.starts_with('P') {
                printed.efforts.push(right.to_owned());
            } else if let Some((sum, value)) = right.rsplit_once(['=', '≈']) {
                let constant = (name.to_owned(), sum.to_owned(), first_number(value));
                printed.constants.push(constant);
            } else {
                printed.letters.insert(name.to_owned(), first_number(right));
            }
        }
        printed
    }

    /// Returns P for a state, with the letters' values, some of which may be overridden.
    pub fn efforts(&self, state: &super::State, set: &BTreeMap<String, f64>) -> Vec<f64> {
        let mut names = self.letters.clone();
        names.extend(set.clone());
        for (name, sum, _) in &self.constants {
            let value = evaluate(sum, &names);
            names.insert(name.clone(), value);
        }
        let values = [
            ("q", &state.q),
            ("q\u{307}", &state.v),
            ("q\u{308}", &state.a),
        ];
        for (symbol, values) in values {
            for (j, &x) in values.iter().enumerate() {
                names.insert(format!("{symbol}{}", subscript(j + 1)), x);
            }
        }
        let efforts = self.efforts.iter();
        efforts.map(|right| evaluate(right, &names)).collect()
    }
}

fn first_number(text: &str) -> f64 {
    let word = text.split_whitespace().next().expect("a value");
    let number = word.replace('−', "-").parse();
    number.unwrap_or_else(|_| panic!("{word} is no number"))
}

fn subscript(n: usize) -> String {
    let digits = n.to_string();
    let shift = |c: char| char::from_u32('₀' as u32 + c.to_digit(10)?);
    digits.chars().map(|c| shift(c).expect("a digit")).collect()
}

/// The value of a printed expression.
pub fn evaluate(text: &str, names: &BTreeMap<String, f64>) -> f64 {
    let plain: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let mut reader = Reader {
        rest: plain.chars().peekable(),
        names,
    };
    let value = reader.sum();
    assert_eq!(reader.rest.next(), None, "read to the end: {text}");
    value
}

struct Reader<'a> {
    rest: Peekable<Chars<'a>>,
    names: &'a BTreeMap<String, f64>,
}

impl Reader<'_> {
    fn eat(&mut self, c: char) -> bool {
        self.rest.next_if_eq(&c).is_some()
    }

    fn sum(&mut self) -> f64 {
        let negative = self.eat('−');
        let first = self.product();
        let mut sum = if negative { -first } else { first };
        loop {
            if self.eat('+') {
                sum += self.product();
            } else if self.eat('−') {
                sum -= self.product();
            } else {
                return sum;
            }
        }
    }

    fn product(&mut self) -> f64 {
        let mut product = self.power();
        while self.eat('·') {
            product *= self.power();
        }
        product
    }

    fn power(&mut self) -> f64 {
        let base = self.base();
        let mut power = String::new();
        while let Some(c) = self.rest.next_if(|c| "⁰¹²³⁴⁵⁶⁷⁸⁹".contains(*c)) {
            let digit = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|d| d == c).expect("a digit");
            power += &digit.to_string();
        }
        if power.is_empty() {
            return base;
        }
        base.powi(power.parse().expect("digits"))
    }

    fn base(&mut self) -> f64 {
        if self.eat('(') {
            return self.closed();
        }
        let next = *self.rest.peek().expect("an expression goes on");
        if next.is_ascii_digit() {
            return self.number();
        }
        let name = self.name();
        match name.as_str() {
            "sin" | "cos" => {
                assert!(self.eat('('), "{name} of what?");
                let angle = self.closed();
                if name == "sin" {
                    angle.sin()
                } else {
                    angle.cos()
                }
            }
            _ => *self.names.get(&name).unwrap_or_else(|| panic!("{name}?")),
        }
    }

    fn closed(&mut self) -> f64 {
        let value = self.sum();
        assert!(self.eat(')'), "a parenthesis is open");
        value
    }

    fn number(&mut self) -> f64 {
        let mut text = String::new();
        while let Some(c) = self.rest.next_if(|c| c.is_ascii_digit() || *c == '.') {
            text.push(c);
        }
        if self.eat('e') {
            text.push('e');
            while let Some(c) = self.rest.next_if(|c| c.is_ascii_digit() || *c == '-') {
                text.push(c);
            }
        }
        text.parse().expect("a number")
    }

    fn name(&mut self) -> String {
        let of_name = |c: &char| {
            c.is_alphanumeric() && !"⁰¹²³⁴⁵⁶⁷⁸⁹".contains(*c)
                || "_,\u{307}\u{308}₀₁₂₃₄₅₆₇₈₉".contains(*c)
        };
        let mut name = String::new();
        while let Some(c) = self.rest.next_if(of_name) {
            name.push(c);
        }
        assert!(!name.is_empty(), "a name before {:?}", self.rest.peek());
        name
    }
}
