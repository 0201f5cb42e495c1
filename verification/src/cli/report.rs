//! `touchstone report`: the site from the rows on disk.

use reports::verdict_line;

use super::environment::Environment;
use super::places::Places;
use super::{CommandError, Finish, print, store};

/// Renders the site again, prints one verdict line a case and the site's path.
///
/// # Errors
///
/// If there are no results, they cannot be read, or pages cannot be written.
pub fn report(places: &Places) -> Result<Finish, CommandError> {
    if !places.results.is_dir() {
        let place = places.results.display();
        return Err(CommandError::input(format!(
            "there are no results in `{place}`; `touchstone` makes them, `--results DIR` names others"
        )));
    }
    let cases = store::render_site(places, &Environment::of(places.root.as_deref()))?;
    for case in &cases {
        print::line(&verdict_line(case));
    }
    print::line(&format!("site: {}", places.site.join("index.html").display()));
    Ok(store::finish_of(&cases))
}
