"""What a kiosk offers its operator."""
