//! A file appears under its name whole or not at all.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::error::ReportError;

/// A file that is written piece by piece and appears when it is finished. Dropped before, it leaves nothing.
#[derive(Debug)]
pub struct AtomicFile {
    path: PathBuf,
    partial: PathBuf,
    file: fs::File,
    finished: bool,
}

impl AtomicFile {
    /// Begins to write under a temporary name in the same folder.
    ///
    /// # Errors
    /// If the system refuses.
    pub fn create(path: &Path) -> Result<Self, ReportError> {
        let partial = hidden_name(path, "part");
        let file = fs::File::create(&partial).map_err(|source| failure(path, source))?;
        Ok(Self {
            path: path.to_owned(),
            partial,
            file,
            finished: false,
        })
    }

    /// Appends.
    ///
    /// # Errors
    /// If the system refuses.
    pub fn append(&mut self, bytes: &[u8]) -> Result<(), ReportError> {
        let written = self.file.write_all(bytes);
        written.map_err(|source| failure(&self.path, source))
    }

    /// A file for what must wait, which goes by this name while the result is in the making.
    pub fn scratch_name(path: &Path) -> PathBuf {
        hidden_name(path, "blocks")
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// If the system refuses; an older file of that name is untouched then.
    pub fn finish(mut self) -> Result<(), ReportError> {
        let synced = self.file.sync_all();
        synced
            .and_then(|()| fs::rename(&self.partial, &self.path))
            .map_err(|source| failure(&self.path, source))?;
        self.finished = true;
        Ok(())
    }
}

/// What an encoder that writes by itself writes is not there before [`AtomicFile::finish`].
impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if !self.finished {
            // The first error is the one to tell.
            let _ = fs::remove_file(&self.partial);
        }
    }
}

/// Writes `bytes` to a temporary name in the same folder and renames it to `path`.
///
/// On any error the temporary file is removed and an older file at `path` is untouched.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    let mut file = AtomicFile::create(path)?;
    file.append(bytes)?;
    file.finish()
}

fn failure(path: &Path, source: std::io::Error) -> ReportError {
    ReportError::Write {
        path: path.to_owned(),
        source,
    }
}

/// `folder/name.ext` becomes `folder/.name.ext.1234.part`, 1234 being the process.
fn hidden_name(path: &Path, ending: &str) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.{ending}", std::process::id()));
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("steradian-atomic-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn replaces_a_file_and_leaves_nothing_else() {
        let folder = folder("replace");
        let path = folder.join("a b.json");
        fs::write(&path, "old").unwrap();
        write_atomically(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_failure_names_the_file_and_leaves_nothing() {
        let folder = folder("failure");
        let taken = folder.join("taken");
        fs::create_dir_all(taken.join("inside")).unwrap();
        let error = write_atomically(&taken, b"new").unwrap_err();
        assert!(error.to_string().contains("taken"));
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        let missing = folder.join("no such folder").join("x.json");
        assert!(write_atomically(&missing, b"new").is_err());
        fs::remove_dir_all(folder).unwrap();
    }
}
