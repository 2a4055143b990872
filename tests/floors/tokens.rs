//! Rust text as tokens, without comments, contents of strings, and code that is compiled for tests only.

/// A word, `::`, or a single character of punctuation; a string or character literal is one `"`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    pub text: String,
    /// Line number, counted from 1.
    pub line: usize,
}

impl Token {
    pub fn is_word(&self) -> bool {
        self.text.starts_with(|c: char| c.is_alphabetic() || c == '_')
    }
}

/// Returns the text of the token at `index`; empty beyond the end.
pub fn text_at(tokens: &[Token], index: usize) -> &str {
    tokens.get(index).map_or("", |token| token.text.as_str())
}

/// Cuts `text` into tokens.
pub fn tokens(text: &str) -> Vec<Token> {
    let chars: Vec<char> = text.chars().collect();
    let (mut tokens, mut at, mut line) = (Vec::new(), 0, 1);
    while at < chars.len() {
        let (end, kind) = next_piece(&chars, at);
        let piece: String = match kind {
            Piece::Skipped => String::new(),
            Piece::Literal => "\"".to_owned(),
            Piece::Code => chars[at..end].iter().collect(),
        };
        if !piece.is_empty() {
            tokens.push(Token { text: piece, line });
        }
        line += chars[at..end].iter().filter(|&&c| c == '\n').count();
        at = end;
    }
    tokens
}

enum Piece {
    /// Space, a comment or a lifetime.
    Skipped,
    Literal,
    Code,
}

/// Returns the end and the kind of the piece of text that begins at `at`.
fn next_piece(chars: &[char], at: usize) -> (usize, Piece) {
    let peek = |ahead: usize| chars.get(at + ahead).copied().unwrap_or(' ');
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let while_from = |from: usize, test: &dyn Fn(char) -> bool| {
        chars[from..].iter().position(|&c| !test(c)).map_or(chars.len(), |length| from + length)
    };
    match peek(0) {
        c if c.is_whitespace() => (at + 1, Piece::Skipped),
        '/' if peek(1) == '/' => (while_from(at, &|c| c != '\n'), Piece::Skipped),
        '/' if peek(1) == '*' => (end_of_block_comment(chars, at), Piece::Skipped),
        '"' => (end_of_string(chars, at), Piece::Literal),
        'r' if peek(1) == '"' || (peek(1) == '#' && matches!(peek(2), '#' | '"')) => {
            (end_of_raw_string(chars, at + 1), Piece::Literal)
        }
        'b' if peek(1) == '"' => (end_of_string(chars, at + 1), Piece::Literal),
        'b' if peek(1) == '\'' => (end_of_character(chars, at + 1), Piece::Literal),
        'b' if peek(1) == 'r' && matches!(peek(2), '#' | '"') => (end_of_raw_string(chars, at + 2), Piece::Literal),
        '\'' if is_name(peek(1)) && peek(2) != '\'' => (while_from(at + 1, &is_name), Piece::Skipped),
        '\'' => (end_of_character(chars, at), Piece::Literal),
        c if is_name(c) => (while_from(at, &is_name), Piece::Code),
        ':' if peek(1) == ':' => (at + 2, Piece::Code),
        _ => (at + 1, Piece::Code),
    }
}

/// Returns the index after a block comment. Block comments nest.
fn end_of_block_comment(chars: &[char], at: usize) -> usize {
    let (mut depth, mut end) = (0, at);
    while end < chars.len() {
        match (chars[end], chars.get(end + 1)) {
            ('/', Some('*')) => (depth, end) = (depth + 1, end + 2),
            ('*', Some('/')) => (depth, end) = (depth - 1, end + 2),
            _ => end += 1,
        }
        if depth == 0 {
            break;
        }
    }
    end.min(chars.len())
}

fn end_of_string(chars: &[char], quote: usize) -> usize {
    end_of_literal(chars, quote, '"')
}

fn end_of_character(chars: &[char], quote: usize) -> usize {
    end_of_literal(chars, quote, '\'')
}

/// Returns the index after the next `delimiter` that no backslash escapes.
fn end_of_literal(chars: &[char], quote: usize, delimiter: char) -> usize {
    let mut end = quote + 1;
    while end < chars.len() && chars[end] != delimiter {
        end += if chars[end] == '\\' { 2 } else { 1 };
    }
    (end + 1).min(chars.len())
}

/// `at` is the first `#` or the quote behind the `r`.
fn end_of_raw_string(chars: &[char], at: usize) -> usize {
    let hashes = chars[at..].iter().take_while(|&&c| c == '#').count();
    let is_end = |end: usize| {
        chars[end] == '"' && chars.len() > end + hashes && chars[end + 1..=end + hashes].iter().all(|&c| c == '#')
    };
    (at + hashes + 1..chars.len()).find(|&end| is_end(end)).map_or(chars.len(), |end| end + hashes + 1)
}

/// Removes the items under `#[cfg(test)]`. Also returns the names of those items that are modules in files of their
/// own.
pub fn without_tests(tokens: &[Token]) -> (Vec<Token>, Vec<String>) {
    let (mut kept, mut test_modules, mut at) = (Vec::new(), Vec::new(), 0);
    while at < tokens.len() {
        if is_test_attribute(&tokens[at..]) {
            let start = end_of_attributes(tokens, at);
            at = end_of_item(tokens, start);
            let item = &tokens[start..at];
            let named = item.iter().position(|token| token.text == "mod").map(|keyword| keyword + 1);
            if let Some(name) = named.filter(|&name| text_at(item, name + 1) == ";") {
                test_modules.push(item[name].text.clone());
            }
        } else {
            kept.push(tokens[at].clone());
            at += 1;
        }
    }
    (kept, test_modules)
}

/// Returns true for `#[cfg(test)]` or `#[cfg(all(test, ...))]`.
fn is_test_attribute(tokens: &[Token]) -> bool {
    let starts = |pattern: &[&str]| pattern.iter().enumerate().all(|(at, &text)| text_at(tokens, at) == text);
    starts(&["#", "[", "cfg", "(", "test", ")"]) || starts(&["#", "[", "cfg", "(", "all", "(", "test"])
}

/// Returns the index after all attributes that begin at `at`.
fn end_of_attributes(tokens: &[Token], mut at: usize) -> usize {
    while text_at(tokens, at) == "#" {
        at = end_of_group(tokens, at + 1);
    }
    at
}

/// Returns the index after the bracket that closes the one at `open`.
fn end_of_group(tokens: &[Token], open: usize) -> usize {
    let mut depth = 0;
    for at in open..tokens.len() {
        match text_at(tokens, at) {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + 1;
        }
    }
    tokens.len()
}

/// Returns the index after the semicolon or block that ends an item, or the comma that ends a field.
fn end_of_item(tokens: &[Token], start: usize) -> usize {
    const ITEMS: [&str; 13] = [
        "pub",
        "fn",
        "mod",
        "use",
        "struct",
        "enum",
        "impl",
        "const",
        "static",
        "type",
        "trait",
        "unsafe",
        "macro_rules",
    ];
    let is_field = !ITEMS.contains(&text_at(tokens, start));
    let mut at = start;
    while at < tokens.len() {
        match text_at(tokens, at) {
            ";" => return at + 1,
            "," if is_field => return at + 1,
            "{" => return end_of_group(tokens, at),
            "(" | "[" => at = end_of_group(tokens, at),
            _ => at += 1,
        }
    }
    at
}
