use super::MassProperties; use crate::shape::Part;
pub enum MassMethod { SumOfParts }
impl std::fmt::Display for MassMethod { fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result { write!(f,"sum") } }
pub fn mass_of_union(parts: &[Part], _o: &dyn Fn(&Part,&Part)->bool) -> (MassProperties, MassMethod) {
  let mut sum = MassProperties::nothing();
  for p in parts { sum = sum.plus(&p.convex.mass_properties().placed(p.position,&p.orientation),1.0); }
  (sum, MassMethod::SumOfParts)
}
