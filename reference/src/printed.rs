//! Results as they were printed: fields by their names, whatever types the module has for them.

/// A printed value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Number(f64),
    /// A vector, row by row.
    List(Vec<Value>),
    Record(Vec<(String, Value)>),
    /// `Err(…)`, with what is in it.
    Error(String),
}

impl Value {
    /// What `{:?}` of a `Result` gave.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        if let Some(error) = text.strip_prefix("Err(") {
            return Ok(Self::Error(error.trim_end_matches(')').to_owned()));
        }
        let unread = || format!("cannot read `{text}`");
        let inner = text.strip_prefix("Ok(").and_then(|rest| rest.strip_suffix(')')).ok_or_else(unread)?;
        let (value, rest) = value(inner).ok_or_else(unread)?;
        if rest.is_empty() { Ok(value) } else { Err(unread()) }
    }

    pub(crate) fn field(&self, name: &str) -> Option<&Self> {
        let Self::Record(fields) = self else { return None };
        fields.iter().find_map(|(own, value)| (own == name).then_some(value))
    }

    pub(crate) fn fields(&self) -> &[(String, Self)] {
        if let Self::Record(fields) = self { fields } else { &[] }
    }

    pub(crate) fn number(&self) -> Option<f64> {
        if let Self::Number(number) = self { Some(*number) } else { None }
    }

    /// A number by its place: row, or row and column. Lists are printed column by column; a number alone is at the first place.
    pub(crate) fn entry(&self, place: &[usize]) -> Option<f64> {
        let Self::List(columns) = self else { return self.number().filter(|_| place.iter().all(|index| *index == 0)) };
        let column = place.get(1).copied().unwrap_or(0);
        let Self::List(rows) = columns.get(column)? else { return None };
        rows.get(*place.first()?)?.number()
    }

    /// All numbers in it, each named by its path, as the slices of a sweep are: `B_x`.
    pub(crate) fn numbers(&self, path: &str, all: &mut Vec<(String, f64)>) {
        let of = |part: &str| if path.is_empty() { part.to_owned() } else { format!("{path}_{part}") };
        match (self, self.vector()) {
            (Self::Number(number), _) => all.push((path.to_owned(), *number)),
            (Self::Record(fields), _) => fields.iter().for_each(|(name, value)| value.numbers(&of(name), all)),
            (_, Some([x, y])) => all.extend([(of("x"), x), (of("y"), y)]),
            _ => {}
        }
    }

    /// A vector's components.
    pub(crate) fn vector(&self) -> Option<[f64; 2]> {
        match self {
            Self::List(parts) => match &parts[..] {
                [only] => only.vector(),
                [x, y] => Some([x.number()?, y.number()?]),
                _ => None,
            },
            _ => None,
        }
    }
}

fn value(text: &str) -> Option<(Value, &str)> {
    if let Some(mut rest) = text.strip_prefix('[') {
        let mut parts = Vec::new();
        loop {
            rest = rest.trim_start_matches([',', ' ']);
            if let Some(rest) = rest.strip_prefix(']') {
                return Some((Value::List(parts), rest));
            }
            let (part, after) = value(rest)?;
            parts.push(part);
            rest = after;
        }
    }
    let end = text.find([',', ' ', ']', '}', '{', '(', ')']).unwrap_or(text.len());
    let (word, rest) = text.split_at(end);
    if let Ok(number) = word.parse() {
        return Some((Value::Number(number), rest));
    }
    if !word.starts_with(|c: char| c.is_alphabetic()) {
        return None;
    }
    let Some(mut rest) = rest.strip_prefix(" {") else { return Some((Value::Record(Vec::new()), rest)) };
    let mut fields = Vec::new();
    loop {
        rest = rest.trim_start_matches([',', ' ']);
        if let Some(rest) = rest.strip_prefix('}') {
            return Some((Value::Record(fields), rest));
        }
        let (name, after) = rest.split_once(": ")?;
        let (field, after) = value(after)?;
        fields.push((name.to_owned(), field));
        rest = after;
    }
}

#[cfg(test)]
mod tests {
    use super::Value;

    #[test]
    fn reads_what_rust_prints() {
        let text = "Ok(All { E0: -1.5e-7, A: [[1.0, 2.0]], S: SliderReaction { force: [[0.0, NaN]], couple: 3.0 } })";
        let value = Value::parse(text).expect("a value");
        assert_eq!(value.field("E0").and_then(Value::number), Some(-1.5e-7));
        assert_eq!(value.field("A").and_then(Value::vector), Some([1.0, 2.0]));
        let slider = value.field("S").expect("a field");
        assert_eq!(slider.field("couple").and_then(Value::number), Some(3.0));
        assert!(slider.field("force").and_then(Value::vector).is_some_and(|[_, y]| y.is_nan()));
        assert!(matches!(Value::parse("Err(DeadCentre { group: \"a\" })"), Ok(Value::Error(_))));
        assert!(Value::parse("").is_err() && Value::parse("Ok(A { b: })").is_err());
    }
}
