// Notation page: symbols, frames, units. Nothing to compile here; docs/theory.md derives what is named.
//
// Model
//  symbol      in code                  meaning                                          paper
//  --------    ---------------------    ---------------------------------------------    -----------
//  t           Body::pose, t            pose coordinates of a body, lengths first        eq. (1)
//  phi         last three of t          rotation vector of a spatial body
//  d           dimension(TaskSpace)     number of pose coordinates: 2, 3, 3, 6
//  rho         Joint::command, rho      commanded coordinates of the actuated joints     eq. (1)
//  q           (role passive)           coordinates of joints without spring             eq. (1), (2)
//  vartheta    (role preloaded)         coordinates of joints with a spring              eq. (3)
//  theta       (role compliant,         coordinates of virtual springs (role "virtual"   eq. (2)
//              name ".theta")           in case files) and of drive springs: an actuated
//                                       joint stands at rho + theta
//  x           ChainSlice::x            all unknown coordinates of one chain: q, vartheta and theta
//                                       in the order of its joints
//  tau, U      torque, energy           torque and energy of a spring                    eq. (2), (3)
//  piece       Piece                    side of every breakpoint on which a state is
//
// Statics
//  e           Closure::e               closure of one chain, d numbers, zero when shut  eq. (5)
//  J           Closure::J               de/dx: Jacobian of the chain's end               eq. (4)
//  H^F         Closure::H               d(J^T F)/dx: Hessian of F . e                    eq. (9)
//  F           ChainSlice::F            wrench that the body at its end exerts on a      eq. (4)
//                                       chain; multiplier of its closure
//  W           Inputs::W                external wrench on a body
//  K           segments' stiffness      d2U/dx2 of one chain, diagonal                   eq. (4)
//  z           z                        all unknowns: (x_i, F_i) per chain, then the poses
//  A           A_full, A                derivative of the equilibrium by z; A_i: the     eq. (10)
//                                       block of the rows and columns (x_i, F_i)
//  B, D        B, D                     blocks of A beside A_i that belong to the poses
//  K_ci        chain_stiffness          Cartesian stiffness of one chain                 eq. (12)
//  K_Sigma     platform_stiffness       stiffness of the platform: sum of the K_ci       Section 4
//  J_l         left_jacobian            Exp(phi + d) = Exp(J_l d) Exp(phi)
//
// Continuation
//  x           x                        in this layer: the unknowns of any problem
//  y           y                        in analysis: z with the free pose coordinates only
//  lambda      lambda                   continuation parameter, nothing else
//  s           s                        arc length along a branch [-]
//  tau         tangent                  in this layer: unit tangent of a branch in (x, lambda)
//  g           switches                 switching functions: coordinate minus breakpoint
//
// Frames: everything is seen from the base frame unless a name says otherwise. R_AB, p_AB, T_AB:
// frame B seen from A. Twists and wrenches have the translational part first and the rotational part
// second; both are given in the axes of the base frame, at the point that the text names.
//
// Units: whatever the case uses, consistently: length, force; angles in radians; moments in
// force * length; energy in force * length. Inside analysis everything is divided by powers of two
// of a length and a force (core/scaling.hpp), so that the engine sees dimensionless numbers and a
// change of units by a power of two changes no digit.
#pragma once
