//! Arrays of an `.npz` archive, checked for type, size and shape before they are numbers.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use npyz::{DType, NpyFile, Order, TypeChar};
use zip::ZipArchive;

use super::ReferenceError;

/// An opened archive.
pub(crate) struct Arrays {
    file: String,
    archive: ZipArchive<BufReader<File>>,
}

/// One array, its last index fastest.
pub(crate) struct Array {
    pub(crate) shape: Vec<usize>,
    pub(crate) values: Vec<f64>,
}

impl Arrays {
    pub(crate) fn open(path: &Path) -> Result<Self, ReferenceError> {
        let file = path.display().to_string();
        let error = |problem: String| ReferenceError { file: file.clone(), array: None, problem };
        let opened = File::open(path).map_err(|cause| error(format!("cannot be read: {cause}")))?;
        let archive = ZipArchive::new(BufReader::new(opened))
            .map_err(|cause| error(format!("{cause}; accepted: an .npz file of numpy.savez")))?;
        Ok(Self { file, archive })
    }

    pub(crate) fn error(&self, array: &'static str, problem: impl Into<String>) -> ReferenceError {
        ReferenceError { file: self.file.clone(), array: Some(array), problem: problem.into() }
    }

    /// Whether there is an array of this name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.archive.index_for_name(&format!("{name}.npy")).is_some()
    }

    /// Reads an array of numbers or booleans. Every integer a reference has is exact as f64.
    pub(crate) fn read(&mut self, name: &'static str) -> Result<Array, ReferenceError> {
        let bytes = self.bytes(name)?;
        let npy = NpyFile::new(bytes.as_slice()).map_err(|cause| self.error(name, cause.to_string()))?;
        let DType::Plain(kind) = npy.dtype() else {
            return Err(self.error(name, "a table with named fields; accepted: plain numbers"));
        };
        if npy.order() != Order::C {
            return Err(self.error(name, "stored column by column; accepted: C order"));
        }
        let item_bytes = kind.num_bytes().unwrap_or(1).max(1);
        let told = npy.shape().iter().try_fold(item_bytes as u64, |product, n| product.checked_mul(*n));
        if told.is_none_or(|told| told > bytes.len() as u64) {
            return Err(self.error(name, format!("cut off: shape {:?} does not fit in it", npy.shape())));
        }
        let shape = npy.shape().iter().map(|n| *n as usize).collect();
        let values = match (kind.type_char(), kind.size_field()) {
            (TypeChar::Float, 8) => npy.into_vec::<f64>(),
            (TypeChar::Float, 4) => wide(npy.into_vec::<f32>()),
            (TypeChar::Int, 4) => wide(npy.into_vec::<i32>()),
            (TypeChar::Int, 8) => npy.into_vec::<i64>().map(|v| v.into_iter().map(|x| x as f64).collect()),
            (TypeChar::Uint, 1) => wide(npy.into_vec::<u8>()),
            (TypeChar::Uint, 4) => wide(npy.into_vec::<u32>()),
            (TypeChar::Bool, 1) => {
                npy.into_vec::<bool>().map(|v| v.into_iter().map(|x| f64::from(u8::from(x))).collect())
            }
            _ => {
                let accepted = "accepted: f8, f4, i4, i8, u1, u4 or bool";
                return Err(self.error(name, format!("its numbers are of type {kind}; {accepted}")));
            }
        };
        let values = values.map_err(|cause| self.error(name, cause.to_string()))?;
        Ok(Array { shape, values })
    }

    fn bytes(&mut self, name: &'static str) -> Result<Vec<u8>, ReferenceError> {
        let file = self.file.clone();
        let error = |problem: String| ReferenceError { file: file.clone(), array: Some(name), problem };
        let mut bytes = Vec::new();
        let mut entry = self.archive.by_name(&format!("{name}.npy")).map_err(|cause| match cause {
            zip::result::ZipError::FileNotFound => error("missing".to_owned()),
            cause => error(cause.to_string()),
        })?;
        entry.read_to_end(&mut bytes).map_err(|cause| error(cause.to_string()))?;
        Ok(bytes)
    }

    /// As [`read`](Self::read), with a shape that has to be `expected`; 0 there accepts any length.
    pub(crate) fn shaped(
        &mut self,
        name: &'static str,
        expected: &[usize],
    ) -> Result<Vec<f64>, ReferenceError> {
        let array = self.read(name)?;
        let fits = array.shape.len() == expected.len()
            && array.shape.iter().zip(expected).all(|(found, wanted)| *wanted == 0 || found == wanted);
        if !fits {
            let found = array.shape;
            return Err(self.error(name, format!("shape {found:?}; accepted: {expected:?} (0: any length)")));
        }
        if let Some(place) = array.values.iter().position(|x| !x.is_finite()) {
            return Err(
                self.error(name, format!("entry {place} is {}; accepted: finite", array.values[place]))
            );
        }
        Ok(array.values)
    }
}

fn wide<T: Into<f64>>(values: std::io::Result<Vec<T>>) -> std::io::Result<Vec<f64>> {
    values.map(|values| values.into_iter().map(Into::into).collect())
}
