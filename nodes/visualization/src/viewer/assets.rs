//! The files of the page, built into the program.

use axum::http::header::{CACHE_CONTROL, CONTENT_TYPE, ETAG, IF_NONE_MATCH};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};

/// One file of the page.
#[derive(Debug)]
pub(crate) struct Asset {
    /// Where a browser finds it.
    pub(crate) paths: &'static [&'static str],
    content_type: &'static str,
    bytes: &'static [u8],
}

/// All of them.
pub(crate) const ASSETS: [Asset; 6] = [
    Asset {
        paths: &["/", "/index.html"],
        content_type: "text/html; charset=utf-8",
        bytes: include_bytes!("../../page/dist/index.html"),
    },
    Asset {
        paths: &["/viewer.js"],
        content_type: "text/javascript; charset=utf-8",
        bytes: include_bytes!("../../page/dist/viewer.js"),
    },
    Asset {
        paths: &["/link.js"],
        content_type: "text/javascript; charset=utf-8",
        bytes: include_bytes!("../../page/dist/link.js"),
    },
    Asset {
        paths: &["/viewer.css"],
        content_type: "text/css; charset=utf-8",
        bytes: include_bytes!("../../page/dist/viewer.css"),
    },
    Asset {
        paths: &["/icon.svg"],
        content_type: "image/svg+xml",
        bytes: include_bytes!("../../page/dist/icon.svg"),
    },
    Asset {
        paths: &["/LICENCES.txt"],
        content_type: "text/plain; charset=utf-8",
        bytes: include_bytes!("../../page/dist/LICENCES.txt"),
    },
];

impl Asset {
    /// The file, or that the browser still has it.
    pub(crate) fn answer(&self, headers: &HeaderMap) -> Response {
        let tag = format!("\"{:08x}\"", crc32fast::hash(self.bytes));
        let known = headers.get(IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == tag.as_bytes());
        let mut response =
            if known { StatusCode::NOT_MODIFIED.into_response() } else { self.bytes.into_response() };
        let headers = response.headers_mut();
        headers.insert(CONTENT_TYPE, HeaderValue::from_static(self.content_type));
        // A node of another version behind the same address has other files.
        headers.insert(CACHE_CONTROL, HeaderValue::from_static("no-cache"));
        if let Ok(tag) = HeaderValue::try_from(tag) {
            headers.insert(ETAG, tag);
        }
        response
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_comes_once_and_then_only_when_it_has_changed() {
        let index = &ASSETS[0];
        let first = index.answer(&HeaderMap::new());
        assert_eq!(first.status(), StatusCode::OK);
        assert_eq!(first.headers()[CONTENT_TYPE], "text/html; charset=utf-8");
        let mut known = HeaderMap::new();
        known.insert(IF_NONE_MATCH, first.headers()[ETAG].clone());
        assert_eq!(index.answer(&known).status(), StatusCode::NOT_MODIFIED);
        known.insert(IF_NONE_MATCH, HeaderValue::from_static("\"other\""));
        assert_eq!(index.answer(&known).status(), StatusCode::OK);
    }
}
