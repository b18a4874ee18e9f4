! A column of NDIM links for AUTO-07p: as many unknowns as links.
!
!   U(i)     angle of link i against x
!   PAR(1)   force at the tip against x, turned by the angle PAR(2), lambda
!
! Torsion springs of stiffness n = NDIM before every link of length 1/n. The equations are divided by
! this stiffness: so AUTO's determinants do not overflow when there are many links.

subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  double precision :: pull
  integer :: i
  pull = par(1)/dble(ndim)**2
  do i = 1, ndim
    f(i) = u(i) - pull*sin(u(i) - par(2))
    if (i > 1) f(i) = f(i) - u(i - 1)
    if (i < ndim) f(i) = f(i) + u(i) - u(i + 1)
  end do
  if (ijac == 0) return
  do i = 1, ndim
    dfdu(i, i) = 1 - pull*cos(u(i) - par(2))
    if (i > 1) dfdu(i, i - 1) = -1
    if (i == ndim) exit
    dfdu(i, i) = dfdu(i, i) + 1
    dfdu(i, i + 1) = -1
  end do
  if (ijac == 1) return
  do i = 1, ndim
    dfdp(i, 1) = -sin(u(i) - par(2))/dble(ndim)**2
  end do
end subroutine func

subroutine stpnt(ndim, u, par, t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  u = 0
  par(1) = 0
  par(2) = 0.01d0
end subroutine stpnt

subroutine bcnd
end subroutine bcnd

subroutine icnd
end subroutine icnd

subroutine fopt
end subroutine fopt

subroutine pvls
end subroutine pvls
