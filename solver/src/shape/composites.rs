use super::Part;
pub fn trilobe(_d:f64,_l:f64)->Vec<Part>{vec![]}
pub fn quadralobe(_d:f64,_l:f64)->Vec<Part>{vec![]}
pub fn cross_in_plane(_d:f64,_l:f64)->Vec<Part>{vec![]}
pub fn cross_in_space(_d:f64,_l:f64)->Vec<Part>{vec![]}
