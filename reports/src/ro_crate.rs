//! RO-Crate metadata: what each file of the site is, for machines that collect research data.

use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::{SiteFile, SiteMeta};

/// SHA-256 of a file's text in hexadecimal digits.
pub(crate) fn sha256(content: &str) -> String {
    Sha256::digest(content.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The metadata file that describes all other files.
pub(crate) fn metadata(files: &[SiteFile], meta: &SiteMeta) -> SiteFile {
    let parts: Vec<Value> = files.iter().map(|file| json!({ "@id": file.path })).collect();
    let mut graph = vec![
        json!({
            "@id": "ro-crate-metadata.json",
            "@type": "CreativeWork",
            "conformsTo": { "@id": "https://w3id.org/ro/crate/1.1" },
            "about": { "@id": "./" },
        }),
        json!({
            "@id": "./",
            "@type": "Dataset",
            "name": "Touchstone: verification and benchmark results for particle-laden flow",
            "description": "Measured rows, the curves behind them and the pages made from them.",
            "version": meta.version,
            "datePublished": meta.date,
            "identifier": format!("commit {}", meta.commit),
            "hasPart": parts,
        }),
    ];
    graph.extend(files.iter().map(|file| {
        json!({
            "@id": file.path,
            "@type": "File",
            "name": file.path,
            "encodingFormat": media_type(&file.path),
            "contentSize": file.content.len().to_string(),
            "sha256": sha256(&file.content),
        })
    }));
    let crate_description = json!({ "@context": "https://w3id.org/ro/crate/1.1/context", "@graph": graph });
    SiteFile { path: "ro-crate-metadata.json".into(), content: format!("{crate_description:#}\n") }
}

fn media_type(path: &str) -> &'static str {
    match path.rsplit('.').next() {
        Some("html") => "text/html",
        Some("jsonl") => "application/jsonl",
        Some("json") => "application/json",
        Some("csv") => "text/csv",
        _ => "text/plain",
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn sha256_is_the_published_one() {
        assert_eq!(super::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
