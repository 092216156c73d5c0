//! Where a reader gets the bytes of files from.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Access to the files that a scene names.
pub trait Files {
    /// All bytes of the file at `path`.
    ///
    /// # Errors
    /// If there is no such file, or it is too large or unreadable.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;
}

/// Why a file could not be read, in the same words on every platform where the reason is a common one.
pub(crate) fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file".into(),
        io::ErrorKind::PermissionDenied => "permission denied".into(),
        _ => error.to_string(),
    }
}

/// Files on disk: regular files up to a size limit.
#[derive(Clone, Debug)]
pub struct DiskFiles {
    /// Larger files are refused, in bytes.
    pub size_limit: u64,
}

impl Default for DiskFiles {
    /// With a limit of 2 GiB.
    fn default() -> Self {
        Self {
            size_limit: 2 << 30,
        }
    }
}

impl Files for DiskFiles {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let metadata = std::fs::metadata(path)?;
        if !metadata.is_file() {
            return Err(io::Error::other("not a regular file"));
        }
        let mut bytes = Vec::new();
        File::open(path)?
            .take(self.size_limit.saturating_add(1))
            .read_to_end(&mut bytes)?;
        if bytes.len() as u64 > self.size_limit {
            return Err(io::Error::other(format!(
                "larger than the limit of {} bytes",
                self.size_limit
            )));
        }
        Ok(bytes)
    }
}

/// Files of another source, with the hash of all that was read of them.
pub struct HashedFiles<'f> {
    files: &'f dyn Files,
    hasher: RefCell<blake3::Hasher>,
}

impl<'f> HashedFiles<'f> {
    /// The same files, none read yet.
    pub fn new(files: &'f dyn Files) -> Self {
        Self {
            files,
            hasher: RefCell::default(),
        }
    }

    /// Counts these bytes as read.
    pub fn add(&self, bytes: &[u8]) {
        let mut hasher = self.hasher.borrow_mut();
        hasher.update(&(bytes.len() as u64).to_le_bytes());
        hasher.update(bytes);
    }

    /// BLAKE3 of the length and the bytes of each file in order of reading, in hexadecimal.
    pub fn hash(&self) -> String {
        self.hasher.borrow().finalize().to_hex().to_string()
    }
}

impl Files for HashedFiles<'_> {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let bytes = self.files.read(path)?;
        self.add(&bytes);
        Ok(bytes)
    }
}

/// Files in memory, for tests and embedded scenes.
#[derive(Clone, Debug, Default)]
pub struct MemoryFiles {
    files: BTreeMap<PathBuf, Vec<u8>>,
}

impl MemoryFiles {
    /// The same with one more file.
    pub fn with(mut self, path: impl Into<PathBuf>, bytes: impl Into<Vec<u8>>) -> Self {
        self.files.insert(path.into(), bytes.into());
        self
    }
}

impl Files for MemoryFiles {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.files
            .get(path)
            .cloned()
            .ok_or_else(|| io::Error::from(io::ErrorKind::NotFound))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_disk_gives_files_up_to_the_limit() {
        let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
        let bytes = DiskFiles::default().read(&manifest).unwrap();
        assert!(bytes.starts_with(b"[package]"));
        let exact = DiskFiles {
            size_limit: bytes.len() as u64,
        };
        assert_eq!(exact.read(&manifest).unwrap(), bytes);
        let short = DiskFiles {
            size_limit: bytes.len() as u64 - 1,
        };
        assert!(
            short
                .read(&manifest)
                .unwrap_err()
                .to_string()
                .contains("limit")
        );
    }

    #[test]
    fn a_directory_is_not_a_file() {
        let directory = Path::new(env!("CARGO_MANIFEST_DIR"));
        assert!(
            DiskFiles::default()
                .read(directory)
                .unwrap_err()
                .to_string()
                .contains("regular file")
        );
        let missing = DiskFiles::default()
            .read(&directory.join("none"))
            .unwrap_err();
        assert_eq!(missing.kind(), io::ErrorKind::NotFound);
    }

    #[test]
    fn the_hash_tells_files_apart_by_content_and_order() {
        let files = MemoryFiles::default()
            .with("a", "1")
            .with("b", "23")
            .with("c", "12")
            .with("d", "3");
        let hash = |names: [&str; 2]| {
            let hashed = HashedFiles::new(&files);
            for name in names {
                hashed.read(Path::new(name)).unwrap();
            }
            hashed.hash()
        };
        assert_eq!(hash(["a", "b"]), hash(["a", "b"]));
        assert_ne!(hash(["a", "b"]), hash(["b", "a"]));
        assert_ne!(hash(["a", "b"]), hash(["c", "d"]));
    }

    #[test]
    fn memory_gives_what_was_put_in() {
        let files = MemoryFiles::default().with("a.obj", "v 0 0 0");
        assert_eq!(files.read(Path::new("a.obj")).unwrap(), b"v 0 0 0");
        assert_eq!(
            files.read(Path::new("b.obj")).unwrap_err().kind(),
            io::ErrorKind::NotFound
        );
    }
}
