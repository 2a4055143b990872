//! Why a glTF file could not be loaded, in one line that names the file and the cause.

/// A file that could not become a scene.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {cause}")]
pub struct LoadError {
    /// The file as the user named it, or the name of built-in bytes.
    pub file: String,
    /// What is wrong with it.
    pub cause: Cause,
}

/// What is wrong with a file.
#[derive(Debug, thiserror::Error)]
pub enum Cause {
    /// Nothing by that name.
    #[error("there is no such file")]
    NoSuchFile,
    /// The operating system refuses.
    #[error("it cannot be read: {0}")]
    Unreadable(String),
    /// Neither binary glTF nor JSON.
    #[error("it is not a glTF file: {0}")]
    NotGltf(String),
    /// Fewer bytes than the header promises.
    #[error("it is cut off: {found} of {expected} bytes are there")]
    CutOff {
        /// Bytes that the header promises.
        expected: usize,
        /// Bytes in the file.
        found: usize,
    },
    /// Not glTF 2.
    #[error("it is glTF version {0}; only version 2 can be read (gltf-pipeline converts version 1)")]
    Version(String),
    /// The file cannot be understood without an extension that we lack.
    #[error("it requires the extension {name}, which is not supported; {hint}")]
    RequiredExtension {
        /// Name in `extensionsRequired`.
        name: String,
        /// What the user can do about it.
        hint: &'static str,
    },
    /// `FILE#SCENE` names no scene of the file.
    #[error("it has no scene {wanted:?}; there is {available}")]
    NoSuchScene {
        /// What was asked for.
        wanted: String,
        /// Names of those that exist.
        available: String,
    },
    /// An index points at nothing.
    #[error("{user} refers to {kind} {index}, which does not exist")]
    DanglingIndex {
        /// Who refers.
        user: String,
        /// What is referred to.
        kind: &'static str,
        /// The index.
        index: usize,
    },
    /// Data of a buffer cannot be had.
    #[error("buffer {buffer}: {problem}")]
    Buffer {
        /// Index of the buffer.
        buffer: usize,
        /// What is wrong.
        problem: String,
    },
    /// A buffer view reaches outside its buffer.
    #[error("buffer view {view} reaches outside buffer {buffer}")]
    BufferView {
        /// Index of the view.
        view: usize,
        /// Index of its buffer.
        buffer: usize,
    },
    /// An accessor cannot be read.
    #[error("accessor {accessor}: {problem}")]
    Accessor {
        /// Index of the accessor.
        accessor: usize,
        /// What is wrong.
        problem: String,
    },
    /// A part of it contradicts itself or the standard, which the sentence names.
    #[error("{0}")]
    Broken(String),
    /// The variant asked for is not in the file.
    #[error("it has no variant {wanted:?}; there is {available}")]
    NoSuchVariant {
        /// What was asked for.
        wanted: String,
        /// Names of those that exist.
        available: String,
    },
    /// NaN, infinity, or a number far outside what metres, nit or candela can mean.
    #[error("{0} is not a finite number of sensible size")]
    NotFinite(String),
    /// A node is its own ancestor or has two parents.
    #[error("node {0} occurs twice in the node tree (a loop, or two parents)")]
    NodeTwice(usize),
    /// The tree is too deep.
    #[error("the node tree is deeper than {0} levels")]
    TooDeep(usize),
    /// More than is sensible to hold in memory.
    #[error("it is too large: {0}")]
    TooLarge(String),
}

impl Cause {
    /// An accessor that cannot be read, and why.
    pub(super) fn accessor(accessor: usize, problem: impl Into<String>) -> Self {
        Self::Accessor { accessor, problem: problem.into() }
    }
}
