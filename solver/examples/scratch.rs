use solver::distance::*;
use solver::{Vector, Orientation};
use std::time::Instant;
struct Rng(u64);
impl Rng { fn u(&mut self)->f64{ self.0^=self.0<<13; self.0^=self.0>>7; self.0^=self.0<<17; (self.0>>11) as f64/(1u64<<53) as f64 }
 fn s(&mut self)->f64{2.0*self.u()-1.0}
 fn q(&mut self)->Orientation{ loop{ let q=nalgebra::Quaternion::new(self.s(),self.s(),self.s(),self.s()); let n=q.norm(); if n>0.1&&n<1.0 {return Orientation::new_normalize(q)} } }
 fn v(&mut self)->Vector{ loop{ let v=Vector::new(self.s(),self.s(),self.s()); let n=v.norm(); if n>0.1&&n<1.0 {return v/n} } } }
fn main(){
  let cores:[(&str,Core,f64);3]=[("box",Core::Box{half_lengths:Vector::new(0.5,0.5,0.5)},1.0),("cyl",Core::Cylinder{radius:0.5,half_length:0.5},1.0),("rod",Core::Cylinder{radius:0.1,half_length:1.0},1.0)];
  let n: usize = std::env::args().nth(1).map_or(100000,|a|a.parse().unwrap());
  for (na,a,_) in &cores { for (nb,b,_) in &cores {
    let mut rng=Rng(88172645463325252);
    let mut pairs=vec![];
    let mut cold=vec![];
    let (mut worst,mut fails,mut over)=(0.0f64,0,0);
    let mut hist=[0;5]; let mut corners=0;
    for _ in 0..n {
      let ra=rng.q(); let rb=rng.q(); let dir=rng.v();
      let pa=Pose{position:Vector::new(rng.s(),rng.s(),rng.s()),rotation:*ra.to_rotation_matrix().matrix()};
      // place at a gap 0..5% along dir
      let rel0=Pose{position:pa.position+dir*5.0,rotation:*rb.to_rotation_matrix().matrix()};
      let s=separation((a,&pa),(b,&rel0),&Query::cold());
      if s.gap>1e-9 {println!("first: {na}-{nb} gap {:e} {:?} corners {} dist {} ra {:?} n {:?}",s.gap,s.outcome,s.corners,s.distance, (pa.rotation.transpose()*s.normal), rel0.rotation.transpose()*s.normal);}
      let s0=s; let gap=0.05*rng.u();
      let pb=Pose{position:rel0.position - s.normal*(s.distance-gap),..rel0};
      let s=separation((a,&pa),(b,&pb),&Query::cold());
      match s.outcome { Outcome::Overlapping=>over+=1, _=>{ let r=Relative::new(&pa,&pb); let nn=pa.rotation.transpose()*s.normal; let l=-a.support(&nn).dot(&nn)+r.support(b,&-nn).dot(&nn); worst=worst.max((s.distance-l).abs()).max(s.gap); if (s.distance-l).abs()>1e-10 || s.gap>1e-10 {fails+=1; if fails<4 {let f=|p:&Pose|{let r=Relative::new(&pa,p); let n=pa.rotation.transpose()*s0.normal; let l=-a.support(&n).dot(&n)+r.support(b,&-n).dot(&n);l}; println!("s0 {:?} f {} second f {}",s0,f(&rel0),f(&pb));println!("on_first local {:?} on_second local {:?} n {:?}", pa.rotation.transpose()*s.on_first, pb.rotation.transpose()*s.on_second, s.normal);println!("{na}-{nb} dist {} gap {} err {:e} cert {:e} {:?}",s.distance,gap,s.distance-gap,s.gap,s.outcome);} } } }
      corners+=s.corners as usize;
      hist[s.outcome as usize]+=1;
      pairs.push((pa,pb,s.normal)); cold.push(s.distance);
    }
    let t=Instant::now(); let mut sum=0.0;
    for (pa,pb,_) in &pairs { sum+=separation((a,pa),(b,pb),&Query::cold()).distance; }
    let tc=t.elapsed().as_secs_f64()/n as f64*1e9;
    // warm: perturb guess by 1e-3
    let hints: Vec<Vector>=pairs.iter().map(|p|{p.2+rng.v()*1e-3}).collect();
    let t=Instant::now();
    for ((pa,pb,_),h) in pairs.iter().zip(&hints) { sum+=separation((a,pa),(b,pb),&Query{guess:Some(*h),cutoff:f64::INFINITY}).distance; }
    let tw=t.elapsed().as_secs_f64()/n as f64*1e9;
    let mut ww=0.0f64; let mut corn=0; let mut ww2=0; 
    for (((pa,pb,_),h),c) in pairs.iter().zip(&hints).zip(&cold) { let s=separation((a,pa),(b,pb),&Query{guess:Some(*h),cutoff:f64::INFINITY}); ww=ww.max((s.distance-c).abs()); corn+=s.corners; if s.outcome==Outcome::Searched {ww2+=1;} }
    println!("{na}-{nb}: worst {worst:.1e} fails {fails} over {over} hist {hist:?} corners {:.1} cold {tc:.0} ns warm {tw:.0} ns (corners {:.1}, searched {ww2}) warm-cold {ww:.1e} {sum:.3}",corners as f64/n as f64,corn as f64/n as f64);
  }}
}
