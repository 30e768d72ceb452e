"""What an event prints: poster and certificates, A4 at 300 dpi."""
