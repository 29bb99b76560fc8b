//! Names that C or the generated files use otherwise.

/// The keywords of C99 and C++17: the header is valid in both.
#[rustfmt::skip]
const KEYWORDS: [&str; 87] = [
    "alignas", "alignof", "and", "and_eq", "asm", "auto", "bitand", "bitor", "bool", "break", "case", "catch",
    "char", "char16_t", "char32_t", "class", "compl", "const", "const_cast", "constexpr", "continue",
    "decltype", "default", "delete", "do", "double", "dynamic_cast", "else", "enum", "explicit", "export",
    "extern", "false", "float", "for", "friend", "goto", "if", "inline", "int", "long", "mutable",
    "namespace", "new", "noexcept", "not", "not_eq", "nullptr", "operator", "or", "or_eq", "private",
    "protected", "public", "register", "reinterpret_cast", "restrict", "return", "short", "signed", "sizeof",
    "static", "static_assert", "static_cast", "struct", "switch", "template", "this", "thread_local", "throw",
    "true", "try", "typedef", "typeid", "typename", "typeof", "union", "unsigned", "using", "virtual", "void",
    "volatile", "wchar_t", "while", "xor", "xor_eq", "requires",
];

/// Names of local variables, and macros of `math.h` that a named number could have.
#[rustfmt::skip]
pub(super) const RESERVED: [&str; 24] = [
    "result", "parameters", "refused", "checked", "c", "i", "k", "status", "M_E", "M_LOG2E", "M_LOG10E", "M_LN2",
    "M_LN10", "M_PI", "M_PI_2", "M_PI_4", "M_1_PI", "M_2_PI", "M_2_SQRTPI", "M_SQRT2", "M_SQRT1_2", "FP_ZERO",
    "FP_NAN", "FP_NORMAL",
];

/// Macros in lower case: of compilers (`gcc` without `-std`), and of headers of the C library.
const MACROS: [&str; 12] = [
    "linux", "unix", "i386", "arm", "errno", "noreturn", "stdin", "stdout", "stderr", "assert",
    "offsetof", "signbit",
];

/// Returns the name of a field or parameter: with `_` behind it, if it is a keyword or a macro.
pub(super) fn field(name: &str) -> String {
    match KEYWORDS.contains(&name) || MACROS.contains(&name) {
        true => format!("{name}_"),
        false => name.to_string(),
    }
}

/// Returns a text that can be inside a comment.
pub(super) fn in_comment(text: &str) -> String {
    text.replace("*/", "* /").replace("/*", "/ *")
}
