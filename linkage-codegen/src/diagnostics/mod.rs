//! What is wrong with a declaration, where, and how to mend it.
//!
//! Errors are collected, not thrown: a stage reports all that it finds, and the next one runs only if none was found.

mod suggest;

use core::cell::RefCell;

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote_spanned;

pub use suggest::closest;

/// A stretch of the source, from its first token to its last.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    start: Span,
    end: Span,
}

impl Place {
    /// A single token.
    #[must_use]
    pub fn at(span: Span) -> Self {
        Self { start: span, end: span }
    }

    /// From the start of this to the end of that.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self { start: self.start, end: other.end }
    }

    /// The first token.
    #[must_use]
    pub fn start(self) -> Span {
        self.start
    }
}

/// One error.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    place: Place,
    message: String,
    /// Whether the same elsewhere is the same mistake.
    once: bool,
}

impl Diagnostic {
    /// A problem at a place.
    #[must_use]
    pub fn new(place: Place, problem: impl Into<String>) -> Self {
        Self { place, message: problem.into(), once: false }
    }

    /// The same at another place.
    #[must_use]
    pub fn moved(self, place: Option<Place>) -> Self {
        Self { place: place.unwrap_or(self.place), ..self }
    }

    /// Where the same is found at several places, it is told at the first.
    #[must_use]
    pub fn once(self) -> Self {
        Self { once: true, ..self }
    }

    /// The way out. Each line of the text stands under the mark.
    #[must_use]
    pub fn help(self, text: impl AsRef<str>) -> Self {
        self.remark("help", text.as_ref())
    }

    /// What explains the problem.
    #[must_use]
    pub fn note(self, text: impl AsRef<str>) -> Self {
        self.remark("note", text.as_ref())
    }

    /// Where the compiler suggests a name, if one is close to what was written.
    #[must_use]
    pub fn suggest<'a>(self, written: &str, names: impl IntoIterator<Item = &'a str>) -> Self {
        let names: Vec<&str> = names.into_iter().collect();
        match closest(written, names.iter().copied()) {
            Some(name) => self.help(format!("did you mean `{name}`?")),
            None if names.is_empty() => self,
            None => self.help(format!("there {} {}", if names.len() == 1 { "is" } else { "are" }, list(&names))),
        }
    }

    fn remark(mut self, mark: &str, text: &str) -> Self {
        let indent = format!("\n{:width$}", "", width = mark.len() + 2);
        self.message.push_str(&format!("\n{mark}: {}", text.trim_end().replace('\n', &indent)));
        self
    }

    /// The text, remarks included.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Where it is.
    #[must_use]
    pub fn place(&self) -> Place {
        self.place
    }

    fn to_tokens(&self) -> TokenStream {
        let (start, end) = (Ident::new("start", self.place.start), Ident::new("end", self.place.end));
        let stretch = quote_spanned!(self.place.start=> #start #end);
        syn::Error::new_spanned(stretch, &self.message).into_compile_error()
    }
}

impl From<syn::Error> for Diagnostic {
    fn from(error: syn::Error) -> Self {
        Self::new(Place::at(error.span()), error.to_string())
    }
}

/// Names in a row: `a`, `b` and `c`.
#[must_use]
pub fn list(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|n| format!("`{n}`")).collect();
    match quoted.as_slice() {
        [] => "nothing".into(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}

/// So many of something: `1 joint`, `2 joints`.
#[must_use]
pub fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

/// Collects errors.
#[derive(Debug, Default)]
pub struct Sink {
    found: RefCell<Vec<Diagnostic>>,
}

impl Sink {
    /// Takes an error.
    pub fn report(&self, diagnostic: impl Into<Diagnostic>) {
        let (diagnostic, mut found) = (diagnostic.into(), self.found.borrow_mut());
        if !diagnostic.once || found.iter().all(|other| other.message != diagnostic.message) {
            found.push(diagnostic);
        }
    }

    /// Takes the error of a result and passes the rest on.
    pub fn absorb<T>(&self, result: Result<T, Diagnostic>) -> Option<T> {
        result.map_err(|e| self.report(e)).ok()
    }

    /// Whether nothing is wrong so far.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.found.borrow().is_empty()
    }

    /// All errors, in the order of their discovery.
    #[must_use]
    pub fn into_errors(self) -> Vec<Diagnostic> {
        self.found.into_inner()
    }
}

/// The errors as `compile_error!` invocations.
#[must_use]
pub fn to_tokens(errors: &[Diagnostic]) -> TokenStream {
    errors.iter().map(Diagnostic::to_tokens).collect()
}
