//! A few checks a browser would do, on the text of a page.

/// All values of an attribute, in order.
pub fn attributes<'a>(html: &'a str, name: &str) -> Vec<&'a str> {
    let opening = format!(" {name}=\"");
    html.split(opening.as_str()).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

/// Addresses that a browser would load by itself rather than on a click.
pub fn loaded_resources(html: &str) -> Vec<String> {
    let mut loaded: Vec<String> = attributes(html, "src").into_iter().map(String::from).collect();
    loaded.extend(html.split("<link ").skip(1).filter_map(|rest| attributes(&format!(" {rest}"), "href").first().map(|a| a.to_string())));
    loaded.extend(html.split("url(").skip(1).filter_map(|rest| rest.split(')').next()).map(String::from));
    loaded.extend(html.split("@import").skip(1).map(|_| "@import".to_string()));
    loaded
}

/// The first tag that is closed without being open or left open, if any.
pub fn unbalanced_tag(html: &str) -> Option<String> {
    const VOID: [&str; 3] = ["meta", "link", "br"];
    let start = html.find("<body")?;
    let body = &html[start..html.find("<script>").unwrap_or(html.len())];
    let mut open: Vec<&str> = Vec::new();
    for piece in body.split('<').skip(1) {
        let tag = piece.split('>').next().unwrap_or_default();
        let name = tag.split([' ', '\n', '/']).find(|part| !part.is_empty()).unwrap_or_default();
        if tag.starts_with('/') {
            if open.pop() != Some(name) {
                return Some(name.to_string());
            }
        } else if !tag.ends_with('/') && !VOID.contains(&name) && !name.starts_with('!') {
            open.push(name);
        }
    }
    // The script and what follows it were cut off, so exactly the body is still open.
    (open != ["body"]).then(|| open.join(" "))
}
