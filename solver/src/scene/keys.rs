//! The reference of all scene keys, read from the schema that the field docs generate.

use schemars::Schema;
use serde_json::{Map, Value};

use super::Scene;

/// One table of a scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyTable {
    /// How it is written: `[scene]`, `[[body]]`, or `pair.normal = { linear_spring_dashpot = {...} }`.
    pub table: String,
    /// What it is.
    pub doc: String,
    /// Its keys.
    pub keys: Vec<Key>,
}

/// One key of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// Name.
    pub name: String,
    /// Type, and the choices if it is a choice.
    pub type_name: String,
    /// Whether it must be there.
    pub required: bool,
    /// Default, if it has one; empty otherwise.
    pub default: String,
    /// What it is.
    pub doc: String,
}

/// The JSON schema of scene files, for editors.
pub fn schema() -> Value {
    schemars::schema_for!(Scene).to_value()
}

/// Every table of a scene file, outer before inner.
pub fn tables() -> Vec<KeyTable> {
    let schema: Schema = schemars::schema_for!(Scene);
    let root = schema.to_value();
    let reader = Reader { definitions: root.get("$defs").and_then(Value::as_object).cloned().unwrap_or_default() };
    let mut tables = Vec::new();
    for (name, property) in properties(&root) {
        let is_list = property.get("type").and_then(Value::as_str) == Some("array");
        let target = if is_list { property.get("items").unwrap_or(&Value::Null) } else { property };
        let heading = if is_list { format!("[[{name}]]") } else { format!("[{name}]") };
        reader.collect(&heading, &name, reader.resolve(target), doc_of(property), &mut tables);
    }
    tables
}

struct Reader {
    definitions: Map<String, Value>,
}

impl Reader {
    /// The schema behind a reference, or the schema itself.
    fn resolve<'a>(&'a self, schema: &'a Value) -> &'a Value {
        let reference = schema.get("$ref").or_else(|| {
            let alternatives = schema.get("anyOf")?.as_array()?;
            alternatives.iter().find_map(|alternative| alternative.get("$ref"))
        });
        reference.and_then(Value::as_str).and_then(|path| self.definitions.get(path.trim_start_matches("#/$defs/"))).unwrap_or(schema)
    }

    /// Adds a table and, after it, the tables its keys hold.
    fn collect(&self, heading: &str, path: &str, schema: &Value, doc: String, tables: &mut Vec<KeyTable>) {
        let required: Vec<&str> =
            schema.get("required").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect();
        let mut keys = Vec::new();
        let mut inner = Vec::new();
        for (name, property) in properties(schema) {
            let target = self.resolve(property);
            keys.push(Key {
                type_name: self.type_name(property),
                required: required.contains(&name.as_str()),
                default: property.get("default").filter(|default| !default.is_null()).map_or(String::new(), Value::to_string),
                doc: with_choices(if doc_of(property).is_empty() { doc_of(target) } else { doc_of(property) }, target),
                name: name.clone(),
            });
            for (variant, body) in table_variants(target) {
                inner.push((format!("{path}.{name} = {{ {variant} = {{ ... }} }}"), format!("{path}.{name}.{variant}"), body));
            }
            if let Some((body, is_list)) = self.inner_table(target) {
                let heading = if is_list { format!("{path}.{name} = [{{ ... }}]") } else { format!("{path}.{name} = {{ ... }}") };
                inner.push((heading, format!("{path}.{name}"), (doc_of(body), body)));
            }
        }
        let own_doc = doc_of(schema);
        tables.push(KeyTable { table: heading.to_string(), doc: if doc.is_empty() { own_doc } else { doc }, keys });
        for (heading, path, (variant_doc, body)) in inner {
            self.collect(&heading, &path, self.resolve(body), variant_doc, tables);
        }
    }

    /// The table that a key holds, or that each item of its list is, if it holds one of a single kind.
    fn inner_table<'a>(&'a self, target: &'a Value) -> Option<(&'a Value, bool)> {
        let item = target.get("items").map(|item| self.resolve(item));
        let body = item.unwrap_or(target);
        body.get("properties").is_some().then_some((body, item.is_some()))
    }

    fn type_name(&self, property: &Value) -> String {
        let target = self.resolve(property);
        if let Some((_, is_list)) = self.inner_table(target) {
            return if is_list { "list of tables" } else { "table" }.to_string();
        }
        let variants = table_variants(target);
        if !variants.is_empty() {
            let names = variants.iter().map(|(name, _)| format!("{{ {name} = ... }}")).collect::<Vec<_>>();
            return format!("table: {}", names.join(" or "));
        }
        let choices = choices(target, self);
        if !choices.is_empty() {
            return choices.join(" | ");
        }
        plain_type(target)
    }
}

fn properties(schema: &Value) -> impl Iterator<Item = (String, &Value)> {
    schema.get("properties").and_then(Value::as_object).into_iter().flatten().map(|(name, property)| (name.clone(), property))
}

fn doc_of(schema: &Value) -> String {
    let text = schema.get("description").and_then(Value::as_str).unwrap_or_default();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A doc followed by what each choice means.
fn with_choices(mut doc: String, schema: &Value) -> String {
    for variant in schema.get("oneOf").and_then(Value::as_array).into_iter().flatten() {
        if let Some(word) = variant.get("const").and_then(Value::as_str) {
            doc.push_str(&format!(" \"{word}\": {}", doc_of(variant)));
        }
    }
    doc
}

/// Variants of an enum that hold a table: name, doc and content.
fn table_variants(schema: &Value) -> Vec<(String, (String, &Value))> {
    let variants = schema.get("oneOf").and_then(Value::as_array).into_iter().flatten();
    variants.flat_map(|variant| properties(variant).map(move |(name, body)| (name, (doc_of(variant), body)))).collect()
}

/// Words or numbers a key may hold.
fn choices(schema: &Value, reader: &Reader) -> Vec<String> {
    let variants = ["oneOf", "anyOf"].iter().find_map(|kind| schema.get(kind).and_then(Value::as_array));
    let words = |variant: &Value| -> Vec<String> {
        let resolved = reader.resolve(variant);
        if let Some(word) = resolved.get("const").and_then(Value::as_str) {
            return vec![format!("\"{word}\"")];
        }
        let listed: Vec<String> = resolved
            .get("enum")
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
            .filter_map(Value::as_str)
            .map(|word| format!("\"{word}\""))
            .collect();
        if !listed.is_empty() {
            return listed;
        }
        let nested = choices(resolved, reader);
        match (nested.is_empty(), plain_type(resolved)) {
            (false, _) => nested,
            (true, plain) if plain == "null" => Vec::new(),
            (true, plain) => vec![plain],
        }
    };
    variants.into_iter().flatten().flat_map(words).collect()
}

fn plain_type(schema: &Value) -> String {
    let kind = match schema.get("type") {
        Some(Value::String(kind)) => kind.as_str(),
        Some(Value::Array(kinds)) => kinds.iter().filter_map(Value::as_str).find(|kind| *kind != "null").unwrap_or("any"),
        _ => "any",
    };
    match kind {
        "array" => {
            let item = schema.get("items").map_or("any".to_string(), plain_type);
            match schema.get("minItems").and_then(Value::as_u64) {
                Some(length) => format!("{length} x {item}"),
                None => format!("list of {item}"),
            }
        }
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_has_a_type_and_a_doc() {
        let tables = tables();
        for table in &tables {
            assert!(!table.doc.is_empty(), "{} has no doc", table.table);
            for key in &table.keys {
                assert!(!key.doc.is_empty(), "{}: {} has no doc", table.table, key.name);
                assert!(!key.type_name.contains("any"), "{}: {} has type {}", table.table, key.name, key.type_name);
            }
        }
    }

    #[test]
    fn choices_and_inner_tables_are_listed() {
        let tables = tables();
        let find = |heading: &str| tables.iter().find(|table| table.table == heading).unwrap_or_else(|| panic!("no table {heading}"));
        let end = &find("pair.normal = { linear_spring_dashpot = { ... } }").keys[2];
        assert_eq!(end.type_name, "\"zero_overlap\" | \"no_attraction\"");
        assert_eq!(end.default, "\"zero_overlap\"");
        assert!(end.doc.contains("\"no_attraction\": When the total normal force is zero"), "{}", end.doc);
        let numerics = find("[numerics]");
        let step = numerics.keys.iter().find(|key| key.name == "step").expect("numerics.step is documented");
        assert_eq!(step.type_name, "number | \"advise\"");
        let body = find("[[body]]");
        let position = body.keys.iter().find(|key| key.name == "position").expect("body.position is documented");
        assert_eq!((position.type_name.as_str(), position.required), ("3 x number", true));
    }
}
