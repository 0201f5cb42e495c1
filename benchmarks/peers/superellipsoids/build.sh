#!/bin/sh
# Builds LIGGGHTS 3.8.0 with superquadrics from Debian's source: sh build.sh FOLDER; leaves FOLDER/LIGGGHTS-PUBLIC-3.8.0/src/lmp_sq.
# Needs deb-src lines in the package sources, libopenmpi-dev, g++ and make. Without VTK; with the contact models of steps.in and hooke/stiffness only.
set -e
mkdir -p "$1" && cd "$1"
apt-get source --download-only liggghts || true # the part with Debian's own changes is not needed
tar xf liggghts_3.8.0+repack1.orig.tar.xz
cd LIGGGHTS-PUBLIC-3.8.0/src
# Two lines that compilers of today refuse, and a file that needs VTK.
sed -i 's/return static_cast< std::ostringstream & >(( std::ostringstream() << std::dec << a ) ).str();/std::ostringstream out; out << std::dec << a; return out.str();/' utils.h
sed -i 's/neighbor->lists\[m\]->numneigh > 0/neighbor->lists[m]->numneigh/' finish.cpp
rm dump_mesh_vtk.cpp dump_mesh_vtk.h
# Every contact model is compiled by itself: these are enough.
grep -e SUPERQUADRIC -e 'HOOKE_STIFFNESS.*COHESION_OFF, ROLLING_OFF' style_contact_model.whitelist >models
echo 'GRAN_MODEL(HOOKE_STIFFNESS, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_OFF, SURFACE_SUPERQUADRIC)' >>models
mv models style_contact_model.whitelist
sed -e 's/-DLAMMPS_GZIP -DLAMMPS_VTK/-DSUPERQUADRIC_ACTIVE_FLAG -DNONSPHERICAL_ACTIVE_FLAG -DLAMMPS_GZIP/' \
    -e '/^VTK/d' -e 's/^sinclude.*//' -e 's/-Wall -Wno-unused-result/-w/' -e 's/-fPIC//' MAKE/Makefile.mpi >MAKE/Makefile.sq
make -j2 sq
