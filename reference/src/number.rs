//! Numbers of a file, as they enter a declaration.
//!
//! A number that went through a double on its way would be another mechanism, and near a change point another answer. So a number keeps
//! its text: where a file means doubles, the double's full decimal expansion; where it means decimals, these; and an expression
//! becomes one of the declaration's own, which the compiler works out far beyond doubles.

use std::f64::consts::PI;

use serde::Deserialize;
use serde_json::Value;

/// What a file's numbers mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Mode {
    /// The nearest double.
    #[default]
    F64,
    /// Exactly what is written; text is an expression.
    Decimal,
}

/// A number as the file has it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Raw {
    Literal(String),
    Expression(String),
}

impl<'de> Deserialize<'de> for Raw {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Value::deserialize(deserializer)? {
            Value::Number(number) => Ok(Self::Literal(number.to_string())),
            Value::String(text) => Ok(Self::Expression(text)),
            other => Err(serde::de::Error::custom(format!("a number is expected, and there is {other}"))),
        }
    }
}

/// A number that has its meaning: an expression of the declaration without a dimension, and the nearest double or one close to it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Number {
    text: String,
    literal: bool,
    pub(crate) value: f64,
}

impl Number {
    pub(crate) fn new(raw: &Raw, mode: Mode) -> Result<Self, String> {
        match (raw, mode) {
            (Raw::Literal(text), mode) => {
                let value: f64 = text.parse().map_err(|_| format!("`{text}` is not a number"))?;
                if !value.is_finite() {
                    return Err(format!("`{text}` is too large for a double"));
                }
                let text = if mode == Mode::F64 { expansion(value) } else { text.clone() };
                Ok(Self { text, literal: true, value })
            }
            (Raw::Expression(text), Mode::Decimal) => {
                let Term { text, value } = Parser::parse(text)?;
                Ok(Self { text, literal: false, value })
            }
            (Raw::Expression(text), Mode::F64) => Err(format!("`{text}` is an expression in a file of doubles")),
        }
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.value == 0.0
    }

    /// Without a dimension, as the components of a direction are.
    pub(crate) fn bare(&self) -> &str {
        &self.text
    }

    /// In a unit: `0.25m`, `(sqrt(2))*1m`.
    pub(crate) fn in_unit(&self, unit: &str) -> String {
        if self.literal { format!("{}{unit}", self.text) } else { format!("{}*1{unit}", self.text) }
    }
}

/// All decimals of a double.
fn expansion(value: f64) -> String {
    // The smallest double has 1074 decimals, and no other one has more.
    let all = format!("{value:.1074}");
    let text = all.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// A part of an expression.
struct Term {
    text: String,
    value: f64,
}

impl Term {
    fn new(text: String, value: f64) -> Self {
        Self { text, value }
    }
}

/// Reads `+ - * / **`, numbers, `pi`, `deg` and functions; everything is without a dimension there, as angles are not here.
struct Parser<'a> {
    rest: &'a str,
}

impl Parser<'_> {
    fn parse(text: &str) -> Result<Term, String> {
        let mut parser = Parser { rest: text };
        let whole = parser.sum().map_err(|problem| format!("`{text}`: {problem}"))?;
        if parser.rest.trim().is_empty() {
            Ok(whole)
        } else {
            Err(format!("`{text}`: `{}` is left over", parser.rest.trim()))
        }
    }

    /// Takes a sign if it is next.
    fn eat(&mut self, sign: &str) -> bool {
        let rest = self.rest.trim_start();
        let found = rest.strip_prefix(sign).filter(|after| sign != "*" || !after.starts_with('*'));
        self.rest = found.unwrap_or(rest);
        found.is_some()
    }

    /// Takes letters, digits or other characters of a kind.
    fn take(&mut self, belongs: impl Fn(char) -> bool) -> String {
        let rest = self.rest.trim_start();
        let end = rest.find(|c| !belongs(c)).unwrap_or(rest.len());
        self.rest = &rest[end..];
        rest[..end].to_owned()
    }

    fn sum(&mut self) -> Result<Term, String> {
        let mut left = self.product()?;
        loop {
            let (sign, plus) = if self.eat("+") {
                ('+', true)
            } else if self.eat("-") {
                ('-', false)
            } else {
                return Ok(left);
            };
            let right = self.product()?;
            let value = if plus { left.value + right.value } else { left.value - right.value };
            left = Term::new(format!("({} {sign} {})", left.text, right.text), value);
        }
    }

    fn product(&mut self) -> Result<Term, String> {
        let mut left = self.signed()?;
        loop {
            let (sign, times) = if self.eat("*") {
                ('*', true)
            } else if self.eat("/") {
                ('/', false)
            } else {
                return Ok(left);
            };
            let right = self.signed()?;
            let value = if times { left.value * right.value } else { left.value / right.value };
            left = Term::new(format!("({}{sign}{})", left.text, right.text), value);
        }
    }

    fn signed(&mut self) -> Result<Term, String> {
        if self.eat("-") {
            let of = self.signed()?;
            return Ok(Term::new(format!("(-{})", of.text), -of.value));
        }
        if self.eat("+") { self.signed() } else { self.power() }
    }

    fn power(&mut self) -> Result<Term, String> {
        let base = self.atom()?;
        if !self.eat("**") {
            return Ok(base);
        }
        let exponent = self.signed()?.value;
        let value = base.value.powf(exponent);
        let text = if (exponent - 0.5).abs() == 0.0 {
            format!("sqrt({})", base.text)
        } else if exponent.fract() == 0.0 && exponent.abs() < 1000.0 {
            let power = format!("({})^{}", base.text, exponent.abs());
            if exponent < 0.0 { format!("(1/{power})") } else { power }
        } else {
            return Err(format!("a power of {exponent} has no place in a declaration"));
        };
        Ok(Term::new(text, value))
    }

    fn atom(&mut self) -> Result<Term, String> {
        if self.eat("(") {
            let inner = self.sum()?;
            return if self.eat(")") { Ok(inner) } else { Err("a parenthesis stays open".into()) };
        }
        let rest = self.rest.trim_start();
        if rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return self.literal();
        }
        let name = self.take(|c| c.is_ascii_alphanumeric() || c == '_');
        match name.as_str() {
            "pi" => return Ok(Term::new("pi".into(), PI)),
            "deg" => return Ok(Term::new("(pi/180)".into(), PI / 180.0)),
            _ => {}
        }
        if !self.eat("(") {
            return Err(format!("`{name}` is not known"));
        }
        let mut arguments = vec![self.sum()?];
        while self.eat(",") {
            arguments.push(self.sum()?);
        }
        if !self.eat(")") {
            return Err("a parenthesis stays open".into());
        }
        function(&name, &arguments)
    }

    fn literal(&mut self) -> Result<Term, String> {
        let mut text = self.take(|c| c.is_ascii_digit() || c == '.');
        if self.rest.starts_with(['e', 'E']) {
            text.push('e');
            self.rest = &self.rest[1..];
            if let Some(sign) = self.rest.chars().next().filter(|c| "+-".contains(*c)) {
                text.push(sign);
                self.rest = &self.rest[1..];
            }
            text.push_str(&self.take(|c| c.is_ascii_digit()));
        }
        let value = text.parse().map_err(|_| format!("`{text}` is not a number"))?;
        // The declaration's literals are those of Rust: no point at either end.
        let text = if text.starts_with('.') { format!("0{text}") } else { text };
        Ok(Term::new(text.trim_end_matches('.').to_owned(), value))
    }
}

/// A function: here its angles are numbers, in the declaration they are angles.
fn function(name: &str, arguments: &[Term]) -> Result<Term, String> {
    Ok(match (name, arguments) {
        ("sqrt", [x]) => Term::new(format!("sqrt({})", x.text), x.value.sqrt()),
        ("sin", [x]) => Term::new(format!("sin({}*1rad)", x.text), x.value.sin()),
        ("cos", [x]) => Term::new(format!("cos({}*1rad)", x.text), x.value.cos()),
        ("tan", [x]) => Term::new(format!("tan({}*1rad)", x.text), x.value.tan()),
        ("asin", [x]) => Term::new(format!("(asin({})/1rad)", x.text), x.value.asin()),
        ("acos", [x]) => Term::new(format!("(acos({})/1rad)", x.text), x.value.acos()),
        ("atan", [x]) => Term::new(format!("(atan({})/1rad)", x.text), x.value.atan()),
        ("atan2", [y, x]) => Term::new(format!("(atan2({}, {})/1rad)", y.text, x.text), y.value.atan2(x.value)),
        _ => return Err(format!("there is no function `{name}` of {}", arguments.len())),
    })
}

#[cfg(test)]
mod tests {
    use super::{Mode, Number, Raw};

    fn number(raw: &Raw, mode: Mode) -> Number {
        Number::new(raw, mode).expect("a number")
    }

    #[test]
    fn doubles_are_written_in_full() {
        let tenth = number(&Raw::Literal("0.1".into()), Mode::F64);
        assert_eq!(tenth.in_unit("m"), "0.1000000000000000055511151231257827021181583404541015625m");
        assert_eq!(number(&Raw::Literal("0.1".into()), Mode::Decimal).in_unit("m"), "0.1m");
        assert_eq!(number(&Raw::Literal("-0.0".into()), Mode::F64).bare(), "0");
        assert_eq!(number(&Raw::Literal("1e3".into()), Mode::F64).bare(), "1000");
        assert!(Number::new(&Raw::Expression("1".into()), Mode::F64).is_err());
    }

    #[test]
    fn expressions_are_translated() {
        let of = |text: &str| number(&Raw::Expression(text.into()), Mode::Decimal);
        assert_eq!(of("(70**2+100**2-80**2)/200").text, "((((70)^2 + (100)^2) - (80)^2)/200)");
        assert_eq!(of("60*deg").in_unit("rad"), "(60*(pi/180))*1rad");
        assert!((of("-2**2 + 1.5e1*.5 - cos(60*deg)*2**-1").value - 3.25).abs() < 1e-15);
        assert!((of("atan2(1, -1)/pi + 4**0.5").value - 2.75).abs() < 1e-15);
        for wrong in ["", "1 +", "(2", "foo", "sin(1, 2)", "2**pi", "1 2"] {
            assert!(Number::new(&Raw::Expression(wrong.into()), Mode::Decimal).is_err(), "{wrong}");
        }
    }
}
