// Notation page: symbols, frames, units. Nothing to compile here; docs/theory.md derives what is named.
//
//  symbol      in code            meaning                                              paper
//  --------    ---------------    -------------------------------------------------    -----------
//  t           pose, t            pose of a body: (p, phi), translations first         eq. (1)
//  rho         rho                commanded coordinates of the actuated joints         eq. (1)
//  q           (role passive)     coordinates of joints without spring                 eq. (1), (2)
//  vartheta    (role preloaded)   coordinates of joints with a spring                  eq. (3)
//  theta       (role compliant)   coordinates of virtual springs                       eq. (2)
//  x           x                  all unknown coordinates of one chain: (q, vartheta, theta)
//  F           F, wrench          wrench that a body exerts on a chain at its end      eq. (4)
//  W           load               external wrench on a body
//  U           energy             spring energy
//  K           K                  d2U/dx2 of one chain, diagonal                       eq. (4)
//  J           J                  d(chain end)/dx                                      eq. (4)
//  H^F         H                  d(J^T F)/dx: Hessian of the chain end contracted     eq. (9)
//                                 with the wrench
//  A           A                  KKT matrix of one chain                              eq. (10)
//  K_c         K_c                Cartesian stiffness of one chain                     eq. (12)
//  K_Sigma     K_Sigma            stiffness of the platform: sum of the K_c            Section 4
//  z           z                  all unknowns of the statics: (x_i, F_i) per chain, then the poses
//  lambda      lambda             continuation parameter, nothing else
//  s           s                  arc length along a branch [-]
//  tau         tangent            unit tangent of a branch in (x, lambda)
//  g           (switch)           switching function: coordinate minus breakpoint
//
// Frames: W is the base frame. R_AB, p_AB: frame B seen from A. Twists and wrenches have the
// translational part first and the rotational part second; both are given in the axes of the base
// frame, at the point that the text names.
//
// Units: whatever the case uses, consistently: length, force; angles in radians; moments in
// force * length; energy in force * length. Inside analysis everything is divided by powers of two
// of a length and a force (core/scaling.hpp), so that the engine sees dimensionless numbers and a
// change of units by a power of two changes no digit.
#pragma once
