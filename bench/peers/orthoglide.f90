! The planar Orthoglide for AUTO-07p: ten unknowns, as in springfold's equations.
!
!   U(1), U(2)    leg_x: deflection of the drive, angle of the knee
!   U(3), U(4)    leg_y: the same
!   U(5), U(6)    force that leg_x bears, x and y
!   U(7), U(8)    force that leg_y bears, x and y
!   U(9), U(10)   position of the tool
!   PAR(1)        force along the diagonal, lambda
!   PAR(2)        command of both drives, less what PAR(3) asks for
!   PAR(3)        stiffness of the knees; drives have stiffness 1, links length 1
!   PAR(4)        growth of the command with that stiffness: 0, or what keeps the unloaded equilibrium in its place
!
! The start point is given by U and PAR in the file of constants. Entries of the derivatives that are
! zero everywhere are not touched: AUTO hands the arrays over cleared.

subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  double precision, parameter :: diagonal = 0.70710678118654752440d0
  double precision :: s1, c1, s2, c2, command
  command = par(2) + par(3)*par(4)
  s1 = sin(u(2))
  c1 = cos(u(2))
  s2 = sin(u(4))
  c2 = cos(u(4))
  f(1) = u(1) - u(5)
  f(2) = par(3)*u(2) - u(5)*s1 - u(6)*c1
  f(3) = u(3) - u(8)
  f(4) = par(3)*u(4) - u(7)*c2 - u(8)*s2
  f(5) = u(9) - command - u(1) + c1
  f(6) = u(10) - s1
  f(7) = u(9) - s2
  f(8) = u(10) - command - u(3) + c2
  f(9) = u(5) + u(7) - par(1)*diagonal
  f(10) = u(6) + u(8) - par(1)*diagonal
  if (ijac == 0) return
  dfdu(1, 1) = 1
  dfdu(1, 5) = -1
  dfdu(2, 2) = par(3) - u(5)*c1 + u(6)*s1
  dfdu(2, 5) = -s1
  dfdu(2, 6) = -c1
  dfdu(3, 3) = 1
  dfdu(3, 8) = -1
  dfdu(4, 4) = par(3) + u(7)*s2 - u(8)*c2
  dfdu(4, 7) = -c2
  dfdu(4, 8) = -s2
  dfdu(5, 1) = -1
  dfdu(5, 2) = -s1
  dfdu(5, 9) = 1
  dfdu(6, 2) = -c1
  dfdu(6, 10) = 1
  dfdu(7, 4) = -c2
  dfdu(7, 9) = 1
  dfdu(8, 3) = -1
  dfdu(8, 4) = -s2
  dfdu(8, 10) = 1
  dfdu(9, 5) = 1
  dfdu(9, 7) = 1
  dfdu(10, 6) = 1
  dfdu(10, 8) = 1
  if (ijac == 1) return
  dfdp(9, 1) = -diagonal
  dfdp(10, 1) = -diagonal
  dfdp(2, 3) = u(2)
  dfdp(4, 3) = u(4)
  dfdp(5, 3) = -par(4)
  dfdp(8, 3) = -par(4)
end subroutine func

subroutine stpnt(ndim, u, par, t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  u = 0
  par(1) = 0
end subroutine stpnt

subroutine bcnd
end subroutine bcnd

subroutine icnd
end subroutine icnd

subroutine fopt
end subroutine fopt

subroutine pvls
end subroutine pvls
